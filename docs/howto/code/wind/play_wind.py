# SPDX-License-Identifier: Apache-2.0
"""Plays a wind sensor: sends a sentence of NMEA 0183 twice a second to the fake device that is
named on the command line."""
import os
import pty
import sys
import time
import tty

sensor, line = pty.openpty()
tty.setraw(line)
device = os.path.join(os.environ["QTPLC_FAKE_DEVICES"], sys.argv[1])
if os.path.lexists(device):
    os.remove(device)
os.symlink(os.ttyname(line), device)
while True:
    sentence = "WIMWV,214.8,R,5.1,M,A"
    checksum = 0
    for character in sentence:
        checksum ^= ord(character)
    os.write(sensor, f"${sentence}*{checksum:02X}\r\n".encode())
    time.sleep(0.5)
