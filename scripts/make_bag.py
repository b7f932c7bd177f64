#!/usr/bin/env python3
"""make_bag.py OUTPUT.bag IMAGE... [--topic /camera/image_raw] [--rate HZ]

A bag of images, as a camera driver publishes them. Beside each image, at the same time, its file name as
std_msgs/String on TOPIC_file; empty names at both ends give listeners time to connect, and to process the last image.
"""
import argparse
import os
import sys

import cv2
import rosbag
import rospy
from sensor_msgs.msg import Image
from std_msgs.msg import String

HEAD_S = 1.
TAIL_S = 3.  # a slow machine needs about a second for a large image


def image_message(image, stamp, frame):
    message = Image(height=image.shape[0], width=image.shape[1], encoding='bgr8', step=3 * image.shape[1],
                    data=image.tobytes())
    message.header.stamp = stamp
    message.header.frame_id = frame
    return message


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('bag')
    parser.add_argument('images', nargs='+')
    parser.add_argument('--topic', default='/camera/image_raw')
    parser.add_argument('--frame', default='camera', help='frame_id of the images')
    parser.add_argument('--rate', type=float, default=2., help='images a second')
    arguments = parser.parse_args()
    if cv2.haveImageReader(arguments.bag):
        sys.exit("make_bag: the bag would overwrite the image '%s'; name the bag before the images" % arguments.bag)
    with rosbag.Bag(arguments.bag, 'w', compression='lz4') as bag:
        stamp = rospy.Time(1)
        bag.write(arguments.topic + '_file', String(''), stamp)
        stamp += rospy.Duration.from_sec(HEAD_S)
        for name in arguments.images:
            image = cv2.imread(name)
            if image is None:
                sys.exit('make_bag: cannot read the image %s' % name)
            bag.write(arguments.topic, image_message(image, stamp, arguments.frame), stamp)
            bag.write(arguments.topic + '_file', String(os.path.basename(name)), stamp)
            stamp += rospy.Duration.from_sec(1 / arguments.rate)
        bag.write(arguments.topic + '_file', String(''), stamp + rospy.Duration.from_sec(TAIL_S))


if __name__ == '__main__':
    main()
