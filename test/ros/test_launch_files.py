#!/usr/bin/env python3
"""Every launch file loads with the arguments it needs, and starts only what the package has."""
import glob
import os
import re
import shlex
import unittest
import xml.etree.ElementTree as ElementTree

import roslaunch.config
import roslaunch.loader
import roslaunch.xmlloader

PACKAGE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FILES = sorted(glob.glob(os.path.join(PACKAGE, 'launch', '*.launch')))
# Of arguments without a default.
VALUES = {'bag': '/a.bag', 'parts': '/parts.yaml', 'goals': '/goals.yaml', 'name': 'camera',
          'frame': 'base', 'inputs': '[left/position/parts, right/position/parts]'}


def arguments_of(file):
    return [arg for arg in ElementTree.parse(file).getroot().findall('arg') if 'value' not in arg.attrib]


def load(file, **arguments):
    needed = {arg.get('name'): VALUES[arg.get('name')] for arg in arguments_of(file) if 'default' not in arg.attrib}
    needed.update(arguments)
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load(file, config, argv=['%s:=%s' % pair for pair in needed.items()],
                                         verbose=False)
    config.assign_machines()
    return config


class LaunchFiles(unittest.TestCase):
    def test_each_loads_and_starts_what_there_is(self):
        plugins = ElementTree.parse(os.path.join(PACKAGE, 'nodelet_plugins.xml'))
        nodelets = {plugin.get('name') for plugin in plugins.iter('class')}
        self.assertGreater(len(FILES), 5)
        for file in FILES:
            with self.subTest(file=os.path.basename(file)):
                config = load(file)
                self.assertEqual(config.config_errors, [])
                self.assertGreater(len(config.nodes), 0)
                for node in config.nodes:
                    for nodelet in re.findall(r'outdoor_omr/\w+', node.args if node.package == 'nodelet' else ''):
                        self.assertIn(nodelet, nodelets)

    def test_each_argument_is_explained(self):
        for file in FILES:
            for arg in arguments_of(file):
                self.assertTrue(arg.get('doc'), '%s of %s has no doc' % (arg.get('name'), os.path.basename(file)))

    def test_cell_names(self):
        config = load(os.path.join(PACKAGE, 'launch', 'cell.launch'), min_cameras='2')
        nodes = {node.namespace + node.name: node for node in config.nodes}
        self.assertEqual(set(nodes), {'/fusion', '/deviation'} | {
            '/%s/%s' % (camera, name) for camera in ('left', 'right')
            for name in ('detector_manager', 'detector', 'position')})
        self.assertIn(['parts', 'fusion/parts'], [list(pair) for pair in nodes['/deviation'].remap_args])
        self.assertEqual(config.params['/fusion/min_cameras'].value, 2)
        self.assertEqual(config.params['/fusion/inputs'].value, ['left/position/parts', 'right/position/parts'])
        self.assertFalse(config.params['/left/position/publish_tf'].value)
        config = load(os.path.join(PACKAGE, 'launch', 'cell.launch'), image='rect', image_kind='rectified')
        detector = [node for node in config.nodes if node.namespace + node.name == '/right/detector'][0]
        self.assertIn(['image', 'rect'], [list(pair) for pair in detector.remap_args])
        self.assertEqual(config.params['/right/position/image_kind'].value, 'rectified')

    def test_cell_passes_on_what_its_guide_tells_to_change(self):
        cell, fusion = (os.path.join(PACKAGE, 'launch', name + '.launch') for name in ('cell', 'fusion'))
        defaults = [{arg.get('name'): arg.get('default') for arg in arguments_of(file)} for file in (cell, fusion)]
        changes = {'camera_position_sigma': .004, 'camera_rotation_sigma': .003, 'min_cameras': 2,
                   'time_tolerance': .015, 'patience': .3, 'tf_timeout': .4, 'max_speed': 3, 'memory': 4,
                   'smoothing': .5}
        self.assertEqual(set(defaults[1]) - {'inputs', 'frame', 'parts', 'name', 'manager', 'publish_tf', 'respawn'},
                         set(changes))
        config = load(cell, image_transport='compressed', **{name: str(value) for name, value in changes.items()})
        for name, value in changes.items():
            self.assertEqual(defaults[0][name], defaults[1][name], name)
            self.assertEqual(value, config.params['/fusion/' + name].value, name)
        self.assertEqual(.4, config.params['/deviation/tf_timeout'].value)
        for camera in ('left', 'right'):
            self.assertEqual('compressed', config.params['/%s/detector/image_transport' % camera].value)

    def test_names_with_spaces(self):
        config = load(os.path.join(PACKAGE, 'launch', 'demo.launch'), bag='/a folder/of bags.bag', rviz='false')
        player = [node for node in config.nodes if node.name == 'player'][0]
        self.assertIn('--bags=/a folder/of bags.bag', shlex.split(player.args))

    def test_cell_on_several_machines(self):
        config = load(os.path.join(PACKAGE, 'launch', 'cell.launch'), right_address='10.0.0.2',
                      env_loader='/opt/ros/noetic/env.sh')
        for node in config.nodes:
            where = '10.0.0.2' if node.namespace == '/right/' else 'localhost'
            machine = node.machine
            self.assertEqual('localhost' if machine.address in ('', 'localhost', '127.0.0.1') else machine.address,
                             where, node.name)


if __name__ == '__main__':
    unittest.main()
