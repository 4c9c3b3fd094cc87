from setuptools import find_packages, setup

PACKAGE = "rover_recorder"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + PACKAGE]),
        ("share/" + PACKAGE, ["package.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
    maintainer="Rover maintainers",
    maintainer_email="maintainers@rover.example",
    description="Recordings of the graph in MCAP: written, salvaged, read.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": ["recorder_node = rover_recorder.node:main"],
    },
)
