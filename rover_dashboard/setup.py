from setuptools import find_packages, setup

PACKAGE = "rover_dashboard"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(),
    package_data={PACKAGE: ["static/*", "static/vendor/uplot/*"]},
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + PACKAGE]),
        ("share/" + PACKAGE, ["package.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
    maintainer="Rover maintainers",
    maintainer_email="maintainers@rover.example",
    description="A live page: camera, map, state and controls of the rover in a browser.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": ["dashboard_node = rover_dashboard.node:main"],
    },
)
