"""lock.py [REQUIREMENTS]: print the lock of the environment that runs this, all of it pinned.

The ROS wheels also leave old-style metadata behind, of names that no package index has; only what
has a RECORD was installed from a wheel.
"""

import sys
from importlib.metadata import distributions
from pathlib import Path

# What colcon asks for, and a test run here does not use.
NOT_LOCKED = {"pip", "coverage", "pytest-cov", "pytest-repeat", "pytest-rerunfailures"}

wanted = sys.argv[1] if len(sys.argv) > 1 else "wheels/requirements.txt"
environment = Path(sys.prefix).relative_to(Path(__file__).resolve().parents[1])
print(f"# Every distribution of {environment}, pinned; made by wheels/lock.py from {wanted}")
for distribution in sorted(distributions(), key=lambda d: d.name.lower()):
    if distribution.read_text("RECORD") is not None and distribution.name not in NOT_LOCKED:
        print(f"{distribution.name}=={distribution.version}")
