#!/usr/bin/env python3
"""Replays a bag with demo.launch under a virtual display and looks for the painted regions in a screenshot of rviz."""

import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

import cv2
import numpy
import rosbag
import rospy
from sensor_msgs.msg import Image

PATIENCE = 60  # [s] for rviz to show the picture
# Debian's rviz was seen to die while it started ("malloc(): unaligned tcache chunk detected"), once in a dozen starts.
STARTS = 3
TOLERANCE = 8  # grey levels
# Colours that only the overlay has, B, G, R, and the least number of their pixels.
FIRST_REGION, FIRST_REGION_PIXELS = (255, 0, 0), 100000
EDGES, EDGE_PIXELS = (0, 255, 255), 1000


def scene():
    image = numpy.full((480, 640, 3), (110, 130, 120), numpy.uint8)
    cv2.circle(image, (213, 240), 100, (60, 40, 230), cv2.FILLED)
    cv2.rectangle(image, (420, 60), (520, 300), (40, 220, 60), cv2.FILLED)
    return image


def write_bag(name):
    """Ten seconds of one picture."""
    pixels = scene()
    with rosbag.Bag(name, "w") as bag:
        for shot in range(20):
            message = Image(height=pixels.shape[0], width=pixels.shape[1], encoding="bgr8", step=3 * pixels.shape[1])
            message.data = pixels.tobytes()
            message.header.stamp = rospy.Time.from_sec(1000 + 0.5 * shot)
            message.header.frame_id = "camera"
            bag.write("/camera/image", message, message.header.stamp)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def start_display():
    """A virtual screen. Returns its process and name."""
    read, write = os.pipe()
    process = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x900x24", "-nolisten", "tcp"],
                               pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    if not number:
        raise SystemExit("Xvfb does not start")
    return process, ":" + number


def screenshot(environment):
    png = subprocess.run(["import", "-window", "root", "png:-"], env=environment, check=True, stdout=subprocess.PIPE)
    return cv2.imdecode(numpy.frombuffer(png.stdout, numpy.uint8), cv2.IMREAD_COLOR)


def count(picture, color):
    return int((numpy.abs(picture.astype(int) - color).max(axis=2) <= TOLERANCE).sum())


def rviz_died(log):
    with open(log, encoding="utf-8") as file:
        return any("[rviz-" in line and "has died" in line for line in file)


def wait_for_overlay(environment, launch, log):
    """Returns the last screenshot and whether the overlay is on it."""
    end = time.monotonic() + PATIENCE
    while True:
        picture = screenshot(environment)
        region, edges = count(picture, FIRST_REGION), count(picture, EDGES)
        print("pixels of the first region: {}, of edges: {}".format(region, edges), flush=True)
        if region >= FIRST_REGION_PIXELS and edges >= EDGE_PIXELS:
            return picture, True
        if time.monotonic() > end or launch.poll() is not None or rviz_died(log):
            return picture, False
        time.sleep(1)


def run_demo(folder, bag, config, environment):
    """Launches the demonstration; returns the last screenshot, whether the overlay is on it, and whether rviz died."""
    log = os.path.join(folder, "roslaunch.log")
    port = str(free_port())
    environment = dict(environment, ROS_MASTER_URI="http://127.0.0.1:" + port)
    with open(log, "w", encoding="utf-8") as output:
        launch = subprocess.Popen(["roslaunch", "-p", port, "outdoor_omr", "demo.launch", "bag:=" + bag,
                                   "image:=/camera/image", "loop:=true", "config:=" + config],
                                  env=environment, stdout=output, stderr=output)
        try:
            picture, shown = wait_for_overlay(environment, launch, log)
            return picture, shown, rviz_died(log)
        finally:
            stop(launch)


def stop(process):
    process.send_signal(signal.SIGINT)
    try:
        process.wait(30)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    bag = os.path.join(folder, "demo.bag")
    write_bag(bag)
    config = os.path.join(folder, "regions.yaml")
    with open(config, "w", encoding="utf-8") as file:
        file.write("overlay_regions: true\n")
    display, name = start_display()
    environment = dict(os.environ, DISPLAY=name, LIBGL_ALWAYS_SOFTWARE="1")
    try:
        for start in range(1, STARTS + 1):
            picture, shown, died = run_demo(folder, bag, config, environment)
            if not died:
                break
            print("rviz died in start {} of {}".format(start, STARTS), flush=True)
    finally:
        stop(display)
    cv2.imwrite(os.path.join(folder, "rviz.png"), picture)
    print("the overlay is" + ("" if shown else " not") + " in", os.path.join(folder, "rviz.png"))
    return 0 if shown else 1


if __name__ == "__main__":
    sys.exit(main())
