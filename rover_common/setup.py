from setuptools import find_packages, setup

PACKAGE = "rover_common"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(),
    package_data={PACKAGE + ".ros": ["*.xml"]},
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + PACKAGE]),
        ("share/" + PACKAGE, ["package.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="Rover maintainers",
    maintainer_email="maintainers@rover.example",
    description="Shared by the rover's packages: types, camera, grids, and what the nodes share.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [],
    },
)
