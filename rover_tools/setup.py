from setuptools import find_packages, setup

PACKAGE = "rover_tools"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(),
    package_data={
        PACKAGE + folder: ["templates/*"] for folder in (".new_part", ".report", ".scoreboard")
    },
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + PACKAGE]),
        ("share/" + PACKAGE, ["package.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="Rover maintainers",
    maintainer_email="maintainers@rover.example",
    description="The rover command line: runs, evaluation, scoreboard and benchmarks.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]} | {"gym": ["gymnasium"]},
    entry_points={
        "console_scripts": ["rover = rover_tools.cli.main:main"],
    },
)
