"""Writes log files with other people's libraries, and beside each the channels that should be found in it.

    pip install numpy scipy npTDMS pytest pyuff "robotpy-wpiutil<2025" \
        h5py hdf5storage mcap mcap-ros2-support openpyxl pyarrow
    python write.py FOLDER
    LISSOM_EXTERNAL=FOLDER cargo test -p lissom-formats --features full --test external -- --nocapture
"""

import pathlib
import sys

import numpy as np

import hdf5_files
import matlab_files
import mcap_files
import numpy_files
import parquet_files
import tdms_files
import uff_files
import wpilog_files
import xlsx_files

SEED = 20261127


def main(folder):
    for module in (numpy_files, matlab_files, wpilog_files, tdms_files, uff_files, hdf5_files, mcap_files, xlsx_files, parquet_files):
        place = pathlib.Path(folder) / module.__name__
        place.mkdir(parents=True, exist_ok=True)
        count = module.write_all(place, np.random.default_rng(SEED))
        print(f"{module.__name__}: {count} files")


if __name__ == "__main__":
    main(sys.argv[1])
