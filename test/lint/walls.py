#!/usr/bin/env python3
"""The walls of the architecture: who may know whom. Prints every line that breaks one."""

import os
import re
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

ROS = re.compile(r"\bros::|\bROS_[A-Z]|\b(sensor|std|geometry|visualization|diagnostic)_msgs\b|\bcv_bridge\b"
                 r"|\bimage_transport\b|\bnodelet\b|#include <(ros|tf2?)\w*/|outdoor_omr/[A-Z]\w*\.h")
OPENCL = re.compile(r"#include <CL/|\bcl::|\bcl_\w+|\bCL_[A-Z]")
CATCH = re.compile(r"\bcatch \(")
STEPS = ["candidates", "checkerboards", "parts", "targets"]


# The folders of a step; each may name those before it, and the files beside the folders all of them.
LAYERS = {
    "checkerboards": ["corners", "lattice", "seeds", "judgement"],
    "targets": ["edges", "family", "seeds", "boundaries", "candidate", "letters"],
}


def other_steps(step):
    """Only detector.cpp may name them all."""
    return re.compile(r'#include "({})/'.format("|".join(other for other in STEPS if other != step)))


def later_layers(step, layer):
    """The layers after this one, and the files beside the folders."""
    later = LAYERS[step][LAYERS[step].index(layer) + 1:]
    return re.compile(r'#include "{}/({})'.format(step, "|".join([name + "/" for name in later] + [r"\w+\.h"])))


# Folder, what it must not mention, except in these files.
WALLS = [
    ("include", ROS, []),
    ("src/core", ROS, []),
    ("src/gpu", ROS, []),
    ("src/tools", ROS, []),
    ("include", OPENCL, []),
    ("src/core", OPENCL, []),
    ("src/tools", OPENCL, []),
    ("src/ros", OPENCL, []),
    ("src/ros", CATCH, ["caught.cpp"]),
] + [
    (os.path.join("src/core", step), other_steps(step), []) for step in STEPS
] + [
    (os.path.join("src/core", step, layer), later_layers(step, layer), []) for step in LAYERS for layer in LAYERS[step]
]


def lines_of(folder, exceptions):
    if not os.path.isdir(os.path.join(ROOT, folder)):
        raise SystemExit("there is no folder " + folder)
    for path, _, names in os.walk(os.path.join(ROOT, folder)):
        for name in sorted(set(names) - set(exceptions)):
            with open(os.path.join(path, name), encoding="utf-8") as file:
                for number, line in enumerate(file, 1):
                    yield "{}:{}".format(os.path.relpath(os.path.join(path, name), ROOT), number), line


def main():
    read = 0
    broken = 0
    for folder, forbidden, exceptions in WALLS:
        for place, line in lines_of(folder, exceptions):
            read += 1
            if forbidden.search(line):
                broken += 1
                print("{}: {}".format(place, line.strip()))
    print("{} lines read, {} break a wall".format(read, broken))
    return 1 if broken or not read else 0


if __name__ == "__main__":
    sys.exit(main())
