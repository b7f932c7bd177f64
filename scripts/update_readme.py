#!/usr/bin/env python3
"""update_readme.py [--check] [OMR_DETECT]

Writes the table of parameters, as "omr_detect --list-parameters" prints it, into README.md; with --check only says
whether it is there.
"""
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
README = os.path.join(ROOT, 'README.md')
BEGIN = '<!-- parameters: written by scripts/update_readme.py -->\n'
END = '<!-- end of parameters -->\n'


def main(arguments):
    check = '--check' in arguments
    programs = [argument for argument in arguments if argument != '--check']
    program = programs[0] if programs else os.path.join(ROOT, 'build/devel/lib/outdoor_omr/omr_detect')
    table = subprocess.check_output([program, '--list-parameters'], universal_newlines=True)
    with open(README) as file:
        text = file.read()
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    updated = before + BEGIN + table + END + after
    if check and updated != text:
        sys.exit("README.md lacks today's parameters: run scripts/update_readme.py")
    if not check:
        with open(README, 'w') as file:
            file.write(updated)


if __name__ == '__main__':
    main(sys.argv[1:])
