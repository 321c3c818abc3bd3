#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
r"""Calls a controller DLL from the host class of ROSCO (NREL), a host of others: for 60 s it holds
the speed of a small model of a turbine in a wind of 13 m/s, and a wrong file of records fails with
a sentence. ROSCO is not a part of QtPLC: download its sources where you like. The class needs numpy
(Debian: python3-numpy).

usage: turn_in_rosco.py ROSCO_SOURCES LIBRARY RECORDS_FILE
       turn_in_rosco.py ~/ROSCO build/release/discon/libdiscon_example.so \
           examples/wind_turbine/records.ini

The exit code is 0 if both are as they should be.
"""
import importlib.util
import sys
import tempfile
import types
from pathlib import Path

PERIOD = 0.0125  # [s]
RATED_SPEED, RATED_TORQUE = 122.9, 43.09e3  # [rad/s], [N m] of the generator
INERTIA = 4653.0  # [kg m^2] of rotor and generator, at the generator
WIND, RATED_WIND = 13.0, 11.4  # [m/s]
WITHOUT_TORQUE = 0.45  # [rad] pitch at which this rotor has no torque


def host_class(sources):
    """Of its file alone: the package needs much that the class does not."""
    for name in ("zmq", "rosco.toolbox.ofTools.util.FileTools"):
        sys.modules[name] = types.ModuleType(name)
    sys.modules["rosco.toolbox.ofTools.util.FileTools"].load_yaml = lambda _: {}  # of another class
    file = sources / "rosco" / "toolbox" / "control_interface.py"
    if not file.is_file():
        sys.exit(f"{file} does not exist; name the folder of ROSCO's sources")
    specification = importlib.util.spec_from_file_location("control_interface", file)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module.ControllerInterface


def turn(host):
    """\\return the speed of the generator [rad/s] and the pitch [rad] after 60 s"""
    speed, torque, pitch = 100.0, 0.0, 0.0
    for call in range(1, round(60.0 / PERIOD) + 1):
        torque, pitch, _ = host.call_controller(
            {
                "iStatus": 1,
                "t": call * PERIOD,
                "dt": PERIOD,
                "bld_pitch": pitch,
                "gen_speed": speed,
                "gen_torque": torque,
                "gen_eff": 1.0,
                "rot_speed": speed / 97.0,
                "Y_MeasErr": 0.0,
                "ws": WIND,
                "Yaw_fromNorth": 0.0,
            }
        )
        if host.aviFAIL.value < 0:
            sys.exit(f"call {call} fails: {host.avcMSG.value.decode()}")
        drive = RATED_TORQUE * (WIND / RATED_WIND) ** 2 * max(0.0, 1.0 - pitch / WITHOUT_TORQUE)
        speed += (drive - torque) / INERTIA * PERIOD
    return speed, pitch


def refusal(make_host, library):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "records.ini"
        file.write_text("[read]\ngeneratorSpeed = 20\n[write]\ngeneratorTorque = 49\n")
        # Its constructor keeps the failure for itself.
        host = make_host(str(library), param_filename=str(file), DT=PERIOD)
        return host.aviFAIL.value, host.avcMSG.value.decode()


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    sources, library, records = (Path(argument).expanduser().resolve() for argument in sys.argv[1:])
    make_host = host_class(sources)
    host = make_host(str(library), param_filename=str(records), DT=PERIOD)
    if host.aviFAIL.value < 0:
        sys.exit(f"the first call fails: {host.avcMSG.value.decode()}")
    speed, pitch = turn(host)
    holds = abs(speed - RATED_SPEED) < 0.01 * RATED_SPEED
    print(f"after 60 s: {speed:.2f} rad/s, pitch {pitch:.3f} rad; {'holds' if holds else 'DOES NOT HOLD'} the speed")
    fail, text = refusal(make_host, library)
    refuses = fail == -1 and "49" in text
    print(f"wrong records: aviFAIL = {fail}, '{text}'")
    return 0 if holds and refuses else 1


if __name__ == "__main__":
    sys.exit(main())
