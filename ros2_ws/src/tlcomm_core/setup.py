"""Build description of tlcomm_core, for colcon and for pip."""

from setuptools import find_packages, setup

PACKAGE = "tlcomm_core"

setup(
    name=PACKAGE,
    version="0.1.0",
    description="Temporal-logic planning, the meeting game, its protocol and world, without ROS.",
    author="tlcomm maintainers",
    author_email="maintainers@tlcomm.dev",
    license="Apache-2.0",
    packages=find_packages(include=[PACKAGE, f"{PACKAGE}.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    python_requires=">=3.11",
    install_requires=[
        "numpy>=1.26",
        "pillow>=10",
        "pydantic>=2.10",
        "pyyaml>=6.0",
        "scipy>=1.11",
    ],
    zip_safe=False,
)
