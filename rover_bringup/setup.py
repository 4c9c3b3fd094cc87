from glob import glob

from setuptools import find_packages, setup

PACKAGE = "rover_bringup"
FOLDERS = ("config", "foxglove", "launch", "rviz", "urdf")

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + PACKAGE]),
        ("share/" + PACKAGE, ["package.xml"]),
        *((f"share/{PACKAGE}/{folder}", sorted(glob(f"{folder}/*.*"))) for folder in FOLDERS),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="Rover maintainers",
    maintainer_email="maintainers@rover.example",
    description="Launch files, parameters, robot model and views of both missions' graphs.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
)
