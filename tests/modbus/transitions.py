#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""All 17 transitions of CiA 402, by their numbers, seen from outside of cortex-ds402-sim.

transitions.py PORT: a Modbus client of another maker leads axis 1 of a drive through its states. It
knows the map of docs/ds402-simulator.md and the standard, and nothing else. It waits for what comes
and judges no time. Exit codes: 0 all were seen;
1 what was not is printed;
77 no pymodbus here.
"""
import sys
import time

try:
    from pymodbus.client import ModbusTcpClient
except ImportError:
    sys.exit(77)

PATIENCE = 60  # s
STATES = {  # mask and value of the status word
    "Not ready to switch on": (0x4F, 0x00), "Switch on disabled": (0x4F, 0x40),
    "Ready to switch on": (0x6F, 0x21), "Switched on": (0x6F, 0x23),
    "Operation enabled": (0x6F, 0x27), "Quick stop active": (0x6F, 0x07),
    "Fault reaction active": (0x4F, 0x0F), "Fault": (0x4F, 0x08),
}
LEADS_TO = {
    0: "Not ready to switch on", 1: "Switch on disabled", 2: "Ready to switch on",
    3: "Switched on", 4: "Operation enabled", 5: "Switched on", 6: "Ready to switch on",
    7: "Switch on disabled", 8: "Ready to switch on", 9: "Switch on disabled",
    10: "Switch on disabled", 11: "Quick stop active", 12: "Switch on disabled",
    13: "Fault reaction active", 14: "Fault", 15: "Switch on disabled", 16: "Operation enabled",
}
SHUTDOWN, SWITCH_ON, ENABLE, DISABLE_VOLTAGE, QUICK_STOP, RESET = 6, 7, 15, 0, 2, 0x80
CYCLIC_VELOCITY = 9
QUICK_STOP_OPTION, FAULT_REACTION_OPTION, PROFILE_ACCELERATION = 0x1000, 0x1008, 0x101C
FAULT, POWER_CYCLE = 0xF000, 0xF00C
COUNTS = 100000  # per rad


class Drive:
    def __init__(self, port):
        self.client = ModbusTcpClient("127.0.0.1", port=port)
        if not self.client.connect():
            sys.exit(f"no connection to port {port}")
        self.seen = set()
        self.heartbeat = 0
        self.velocity = 0
        self.write(0x2000, [0])  # this client is no master that keeps time

    def write(self, address, values):
        answer = self.client.write_registers(address, values, slave=1)
        if answer.isError():
            sys.exit(f"writing {values} to {address:04X}: {answer}")

    def write32(self, address, value):
        self.write(address, [value >> 16 & 0xFFFF, value & 0xFFFF])

    def exchange(self, word):
        self.heartbeat = self.heartbeat + 1 & 0xFFFF
        told = [word, CYCLIC_VELOCITY, 0, 0, self.velocity >> 16 & 0xFFFF, self.velocity & 0xFFFF]
        told += [0] * (32 - len(told)) + [self.heartbeat, 0]
        answer = self.client.readwrite_registers(
            read_address=0x100, read_count=52, write_address=0, write_registers=told, slave=1)
        if answer.isError() or answer.registers[48] != self.heartbeat:
            sys.exit(f"no answer to the word {word:04X}: {answer}")
        return self.look(answer.registers)

    def look(self, registers):
        """The number of the last transition, where the state is the one that it leads to."""
        status, number = registers[0], registers[15] & 0xFF
        mask, value = STATES[LEADS_TO[number]]
        if status & mask != value:
            sys.exit(f"transition {number} leads to {LEADS_TO[number]}, and the status word is "
                     f"{status:04X}")
        return number

    def comes(self, number, word, again=lambda: None):
        """Says the word until the transition is seen; `again` helps where it was too short."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            last = self.exchange(word)
            self.seen.add(last)
            if last == number:
                return
            again()
        sys.exit(f"transition {number} does not come with the word {word:04X}; seen were "
                 f"{sorted(self.seen)}")

    def lead(self, *steps):
        for number, word in steps:
            self.comes(number, word)

    def enable(self):
        self.lead((2, SHUTDOWN), (3, SWITCH_ON), (4, ENABLE))


def main():
    drive = Drive(int(sys.argv[1]))
    drive.comes(1, DISABLE_VOLTAGE)
    drive.seen.clear()

#Power off and on again, as it was on before this client came.
    drive.write(POWER_CYCLE, [1])
    drive.comes(0, DISABLE_VOLTAGE, lambda: drive.write(POWER_CYCLE, [1]))
    drive.comes(1, DISABLE_VOLTAGE)

    drive.lead((2, SHUTDOWN), (7, DISABLE_VOLTAGE), (2, SHUTDOWN), (7, QUICK_STOP))
    drive.lead((2, SHUTDOWN), (3, SWITCH_ON), (6, SHUTDOWN), (3, SWITCH_ON), (10, DISABLE_VOLTAGE))
    drive.lead((2, SHUTDOWN), (3, SWITCH_ON), (10, QUICK_STOP))
    drive.enable()
    drive.lead((5, SWITCH_ON), (4, ENABLE), (8, SHUTDOWN), (4, ENABLE), (9, DISABLE_VOLTAGE))

    drive.write32(QUICK_STOP_OPTION, 6)  # and stays
    drive.enable()
    drive.lead((11, QUICK_STOP), (16, ENABLE), (11, QUICK_STOP), (12, DISABLE_VOLTAGE))
    drive.write32(QUICK_STOP_OPTION, 2)  # and goes on by itself
    drive.enable()
    drive.comes(12, QUICK_STOP)

#A fault in motion, which the drive brakes so slowly that this is seen.
    drive.write32(FAULT_REACTION_OPTION, 1)
    drive.write32(PROFILE_ACCELERATION, COUNTS // 2)
    drive.enable()
    drive.velocity = COUNTS // 5
    while drive.client.read_holding_registers(0x104, 2, slave=1).registers[1] < drive.velocity / 2:
        drive.exchange(ENABLE)
    drive.write(FAULT, [0x2310])
    drive.comes(13, ENABLE)
    drive.comes(14, ENABLE)
    drive.velocity = 0
    drive.comes(15, RESET)

    missing = sorted(set(range(17)) - drive.seen)
    print(f"seen: {sorted(drive.seen)}" + (f"; missing: {missing}" if missing else ""))
    sys.exit(bool(missing))


if __name__ == "__main__":
    main()
