"""Print the lock file of the environment that runs this: every real distribution, pinned.

The ROS wheels also leave old-style metadata behind, of names that no package index has; only what
has a RECORD was installed from a wheel.
"""

from importlib.metadata import distributions

NOT_LOCKED = {"pip"}

print("# Every distribution of .venv, pinned; made by wheels/lock.py from wheels/requirements.txt")
for distribution in sorted(distributions(), key=lambda d: d.name.lower()):
    if distribution.read_text("RECORD") is not None and distribution.name not in NOT_LOCKED:
        print(f"{distribution.name}=={distribution.version}")
