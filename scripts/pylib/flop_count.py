"""Floating-point operations of the rod's step: the program rod_steps says how often the instruction
at each address is executed, the disassembly what it does."""

import re
import shutil
import subprocess

VECTOR_BYTES = {'x': 16, 'y': 32, 'z': 64}
ARITHMETIC = re.compile(r'v?(?:(?P<fma>fn?m(?:add|sub)(?:132|213|231))|add|sub|mul|div|sqrt)'
                        r'(?P<packed>[ps])(?P<kind>[sd])$')


def can_count():
    """Whether there is a disassembler (Debian: binutils)."""
    return shutil.which('objdump') is not None


def operations(mnemonic, operands):
    """How many additions, multiplications, divisions and square roots an instruction is (a fused
    one is two); comparisons, conversions and moves are none."""
    found = ARITHMETIC.match(mnemonic)
    if not found:
        return 0
    each = 2 if found['fma'] else 1
    if found['packed'] == 's':
        return each
    registers = re.findall(r'%([xyz])mm', operands)
    return each * VECTOR_BYTES[registers[-1]] // (8 if found['kind'] == 'd' else 4)


def disassembled(program):
    """{address: operations} of the instructions that have any."""
    text = subprocess.run(['objdump', '-d', '--no-show-raw-insn', program], capture_output=True,
                          text=True, check=True).stdout
    found = {}
    for address, mnemonic, operands in re.findall(r'^ +([0-9a-f]+):\t(\S+) *(.*)$', text, re.M):
        count = operations(mnemonic, operands)
        if count:
            found[int(address, 16)] = count
    return found


def total(each, executions):
    """Operations of what rod_steps printed; `each` as `disassembled` gives it."""
    lines = (line.split() for line in executions.splitlines())
    return sum(each.get(int(address, 16), 0) * int(times) for address, times in lines)
