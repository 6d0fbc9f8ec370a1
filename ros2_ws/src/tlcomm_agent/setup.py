"""Build description of tlcomm_agent, for colcon and for pip."""

from setuptools import find_packages, setup

PACKAGE = "tlcomm_agent"

setup(
    name=PACKAGE,
    version="0.1.0",
    description="The ROS 2 node of one agent, a thin shell around tlcomm_core.",
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
        "tlcomm_core",
    ],
    entry_points={"console_scripts": ["agent = tlcomm_agent.node:main"]},
    zip_safe=False,
)
