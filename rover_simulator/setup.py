from setuptools import find_packages, setup

PACKAGE = "rover_simulator"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + PACKAGE]),
        ("share/" + PACKAGE, ["package.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="Rover maintainers",
    maintainer_email="maintainers@rover.example",
    description="Stands in for the Unity simulator on its own wire protocol.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [
            "simulator = rover_simulator.main:main",
            "simulator_node = rover_simulator.node:main",
        ],
    },
)
