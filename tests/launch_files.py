"""Where the launch files are."""

from readme_tables import ROOT

FOLDER = ROOT / "rover_bringup" / "launch"
