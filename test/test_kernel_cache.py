#!/usr/bin/env python3
"""test_kernel_cache.py OMR_DETECT OMR_COMPILE: the first start, which finds no kernels in PoCL's cache, takes no more memory than others."""
import glob
import os
import subprocess
import sys
import tempfile
import time
import unittest

import cv2
import numpy as np

OMR_DETECT = ''
COMPILER = 60  # least that PoCL's compiler takes in a process [MB]


def peak(environment, image):
    """Runs omr_detect on PoCL's device; returns the most memory that it had resident, its children's not counted [MB]."""
    process = subprocess.Popen([OMR_DETECT, '--device', 'cpu', '--json', os.devnull, image], env=environment)
    most = 0
    while process.poll() is None:
        with open('/proc/%d/status' % process.pid) as status:
            for line in status:
                if line.startswith('VmHWM:'):
                    most = max(most, int(line.split()[1]) / 1024)
        time.sleep(.002)
    assert process.returncode == 0
    return most


class KernelCache(unittest.TestCase):
    def setUp(self):
        devices = subprocess.run([OMR_DETECT, '--list-devices'], stdout=subprocess.PIPE, universal_newlines=True).stdout
        if 'Portable Computing Language' not in devices:
            self.fail('there is no PoCL: scripts/setup installs pocl-opencl-icd')
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.image = os.path.join(self.folder.name, 'image.png')
        cv2.imwrite(self.image, np.full((240, 320, 3), 128, np.uint8))
        self.cache = os.path.join(self.folder.name, 'cache')
        os.mkdir(self.cache)
        self.environment = dict(os.environ, POCL_CACHE_DIR=self.cache)

    def stamps(self):
        return [(stamp, os.stat(stamp).st_mtime_ns) for stamp in glob.glob(self.cache + '/outdoor_omr.*')]

    def test_first_start_takes_no_more_memory_than_the_next(self):
        first = peak(self.environment, self.image)
        self.assertLess(first, peak(self.environment, self.image) + COMPILER)

    def test_kernels_are_built_once(self):
        peak(self.environment, self.image)
        stamps = self.stamps()
        self.assertEqual(len(stamps), 1)
        peak(self.environment, self.image)
        self.assertEqual(self.stamps(), stamps)

    def test_kernels_are_built_in_the_process_if_the_program_is_missing(self):
        library = os.path.join(os.path.dirname(os.path.dirname(OMR_DETECT)), 'liboutdoor_omr.so')
        copy = os.path.join(self.folder.name, 'liboutdoor_omr.so')
        os.symlink(library, copy)
        environment = dict(self.environment, LD_PRELOAD=copy)
        peak(environment, self.image)
        self.assertEqual(self.stamps(), [])


if __name__ == '__main__':
    OMR_DETECT = os.path.abspath(sys.argv[1])
    del sys.argv[1:3]
    unittest.main()
