"""Build description of tlcomm_tools, for colcon and for pip."""

from setuptools import find_packages, setup

PACKAGE = "tlcomm_tools"

setup(
    name=PACKAGE,
    version="0.1.0",
    description="The tlcomm command: supervisor of a run, recorder and audit.",
    author="tlcomm maintainers",
    author_email="maintainers@tlcomm.dev",
    license="Apache-2.0",
    packages=find_packages(include=[PACKAGE, f"{PACKAGE}.*"]),
    package_data={
        PACKAGE: ["py.typed", "report/assets/*", "runtime/loopback.xml", "runtime/prompt.xml"]
    },
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        (f"share/{PACKAGE}/config", ["config/tlcomm.rviz", "config/tlcomm.foxglove.json"]),
    ],
    python_requires=">=3.11",
    install_requires=[
        "lz4",
        "matplotlib",
        "numpy",
        "plotly",
        "pyyaml",
        "rosbags",
        "tlcomm_agent",
        "tlcomm_core",
        "tlcomm_sim",
        "websockets",
        "zstandard",
    ],
    extras_require={"dask": ["distributed"]},
    entry_points={"console_scripts": ["tlcomm = tlcomm_tools.cli:main"]},
    zip_safe=False,
)
