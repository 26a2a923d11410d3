"""For the tests of the programs' command lines: runs one, in a folder of its own."""
import os
import shutil
import subprocess
import tempfile
import unittest

SOURCE = os.environ['COSSERAT_CABLE_SOURCE_DIR']
TOOLS = os.environ['COSSERAT_CABLE_TOOLS_DIR']
SWEEP_URDF = os.path.join(SOURCE, 'urdf', 'sweep.urdf')
SWEEP_YAML = os.path.join(SOURCE, 'config', 'cables', 'sweep.yaml')
SWEEP_BAG = os.path.join(SOURCE, 'test', 'data', 'sweep.bag')
CAR_URDF = os.path.join(SOURCE, 'urdf', 'car.urdf')
CAR_YAML = os.path.join(SOURCE, 'config', 'cables', 'car.yaml')
RIDE_BAG = os.path.join(SOURCE, 'test', 'data', 'ride.bag')


def run(tool, *arguments, timeout=300):
    """Exit code and all text of a tool."""
    done = subprocess.run([os.path.join(TOOLS, tool), *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True, timeout=timeout)
    return done.returncode, done.stdout


class CommandLine(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.output_folder = os.path.join(self.folder, 'output')
        os.mkdir(self.output_folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def refused(self, *expected, vehicle=SWEEP_URDF, cables=SWEEP_YAML, bag=SWEEP_BAG):
        """Both tools exit with 2, say all of `expected`, and write nothing."""
        inputs = ['--vehicle', vehicle, '--cables', cables, '--bag', bag]
        output = ['--output', os.path.join(self.output_folder, 'out.bag')]
        for tool, arguments in (('cable_check', inputs), ('cable_replay', inputs + output)):
            code, text = run(tool, *arguments)
            self.assertEqual(code, 2, '%s: %s' % (tool, text))
            for words in expected:
                self.assertIn(words, text, tool)
            self.assertEqual(os.listdir(self.output_folder), [], tool)

    def cables(self, *changes):
        """The sweep's cable file with pieces of its text replaced."""
        with open(SWEEP_YAML) as source:
            text = source.read()
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        with open(self.path('cables.yaml'), 'w') as target:
            target.write(text)
        return self.path('cables.yaml')
