"""Removes the shared memory of a domain's ports, which Fast DDS leaves behind even if its node ends normally."""
import glob
import os


def remove_port_files():
    first = 7400 + 250 * int(os.environ["ROS_DOMAIN_ID"])
    for port in range(first, first + 250):
        for file in glob.glob(f"/dev/shm/*fastrtps_port{port}*"):
            try:
                os.remove(file)
            except FileNotFoundError:
                pass
