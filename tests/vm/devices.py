# SPDX-License-Identifier: Apache-2.0
"""Devices of the virtual machine, made of test drivers of the kernel, each of them tried with the
tools of Debian before our library sees it."""
import ctypes
import fcntl
import glob
import os
import re
import struct
from pathlib import Path

from steps import Process, Skipped, command, wait_until

CONFIG = Path("/sys/kernel/config/gpio-sim/bench")
LINES = 8
I2C_ADDRESSES = ("0x20", "0x68", "0x76")  # a port expander, an IMU, a barometer
SYSFS_ADDRESSES = ("0x48", "0x49")  # a thermometer LM75, a converter ADS1015: for drivers of the kernel
SPI_ANSWER = "/sys/module/spi_loop/parameters/answer"
SPI_TRANSFER = struct.Struct("=QQIIHBBBBBB")  # struct spi_ioc_transfer


def kernel_is_real_time():
    assert Path("/sys/kernel/realtime").read_text().strip() == "1", "/sys/kernel/realtime is not 1"
    return os.uname().release


class Bench:
    """What the kernel has made, as the tests name it."""

    def __init__(self):
        self.can = self.gpio = self.i2c = self.spi = self.sysfs = ""
        self.gpio_lines = None  # folder with the kernel's view of the lines
        self.modules = Path("/lib/modules")
        self.modules.mkdir(parents=True, exist_ok=True)
        command("mount", "--bind", f"{os.environ['QTPLC_VM_KERNEL']}/lib/modules", self.modules)
        command("ip", "link", "set", "lo", "up")

    def environment(self):
        """What the conformance test of the drivers asks for."""
        values = {}
        if self.can:
            values["QTPLC_TEST_CAN"] = self.can
        if self.gpio:
            values["QTPLC_TEST_GPIO"] = f"{self.gpio}:{self.gpio_lines}:2:5"
        if self.i2c:
            values["QTPLC_TEST_I2C"] = f"{self.i2c}:0x68"
        if self.sysfs:
            values["QTPLC_TEST_SYSFS"] = ":".join((self.sysfs, *SYSFS_ADDRESSES))
        if self.spi:
            values["QTPLC_TEST_SPI"] = f"{self.spi}:{SPI_ANSWER}"
        return values

    def build_folder(self, name):
        return f"{os.environ['QTPLC_VM']}/{name}-{os.environ['QTPLC_VM_VERSION']}"

    # ---- CAN ----

    def make_can(self):
        command("modprobe", "vcan", "echo=1")  # frames are confirmed as by a controller
        command("modprobe", "sch_tbf")  # makes a slow queue
        command("modprobe", "can-raw")
        command("ip", "link", "add", "vcan0", "type", "vcan")
        command("ip", "link", "set", "vcan0", "mtu", 72)
        command("ip", "link", "set", "vcan0", "up")
        with Process("candump", "-L", "-n", "2", "vcan0") as dump:
            wait_until(
                lambda: re.search(r"vcan0\s+\d", Path("/proc/net/can/rcvlist_all").read_text()), "candump listens"
            )
            command("cansend", "vcan0", "123#11223344")
            command("cansend", "vcan0", "124##1AABBCC")
            dump.wait()
            assert re.search(r"123#11223344\s.*124##.AABBCC\s", dump.output(), re.S), dump.output()
        self.can = "vcan0"

    # ---- GPIO ----

    def make_gpio(self):
        command("insmod", f"{self.build_folder('modules')}/gpio_sim.ko")
        bank = CONFIG / "bank0"
        bank.mkdir(parents=True)
        (bank / "num_lines").write_text(str(LINES))
        (bank / "label").write_text("qtplc")
        (CONFIG / "live").write_text("1")
        chip = (bank / "chip_name").read_text().strip()
        self.gpio_lines = Path("/sys/devices/platform") / (CONFIG / "dev_name").read_text().strip() / chip
        wait_until(Path(f"/dev/{chip}").exists, f"/dev/{chip}")
        self.gpio = chip
        self.set_input(2, True)
        assert command("gpioget", chip, 2).strip() == "1"
        self.set_input(2, False)
        assert command("gpioget", chip, 2).strip() == "0"
        with Process("gpioset", "--mode=signal", chip, "3=1"):
            wait_until(lambda: self.output(3) == 1, "line 3 is high")
        return f"{chip}, {LINES} lines"

    def line(self, number):
        return self.gpio_lines / f"sim_gpio{number}"

    def set_input(self, number, is_high):
        """What is outside of the chip pulls the line."""
        (self.line(number) / "pull").write_text("pull-up" if is_high else "pull-down")

    def output(self, number):
        """The level of the line as the kernel has it."""
        return int((self.line(number) / "value").read_text())

    def gpio_record(self):
        return GpioRecord()

    # ---- I2C ----

    def make_i2c(self):
        command("modprobe", "i2c-dev")
        command("modprobe", "i2c-stub", f"chip_addr={','.join(I2C_ADDRESSES + SYSFS_ADDRESSES)}")
        names = {
            Path(path).read_text().strip(): path.split("/")[-2] for path in glob.glob("/sys/bus/i2c/devices/i2c-*/name")
        }
        bus = next(bus for name, bus in names.items() if name.startswith("SMBus stub"))
        wait_until(Path(f"/dev/{bus}").exists, f"/dev/{bus}")
        number = bus.split("-")[1]
        command("i2cset", "-y", number, "0x20", "0x05", "0x5a")
        assert command("i2cget", "-y", number, "0x20", "0x05").strip() == "0x5a"
        self.i2c = f"/dev/{bus}"
        return f"{self.i2c} with {', '.join(I2C_ADDRESSES)}"

    # ---- chips with a driver of the kernel ----

    def make_sysfs(self):
        command("modprobe", "lm75")
        command("modprobe", "ti-ads1015")
        number = self.i2c.split("-")[1]
        bus = Path(f"/sys/bus/i2c/devices/i2c-{number}")
        thermometer = SYSFS_ADDRESSES[0]
        command("i2cset", "-y", number, thermometer, "0", "0x8019", "w")  # 25.5 degC, the high byte first
        (bus / "new_device").write_text(f"lm75 {thermometer}")
        try:
            values = glob.glob(f"{bus}/*{thermometer[2:]}/hwmon/hwmon*/temp1_input")
            assert [Path(value).read_text().strip() for value in values] == ["25500"], values
        finally:
            (bus / "delete_device").write_text(thermometer)
        self.sysfs = number
        return f"LM75 and ADS1015 at i2c-{number}"

    # ---- SPI ----

    def make_spi(self):
        command("insmod", f"{self.build_folder('spi_loop')}/spi_loop.ko")
        chip = next(Path(path) for path in glob.glob("/sys/bus/spi/devices/spi*.0"))
        (chip / "driver_override").write_text("spidev")
        Path("/sys/bus/spi/drivers/spidev/bind").write_text(chip.name)
        device = Path(f"/dev/spidev{chip.name[3:]}")
        wait_until(device.exists, str(device))
        sent = bytes(range(16))
        assert transfer(device, sent) == sent, "what was sent did not come back"
        self.spi = str(device)
        return self.spi

    def test_spi(self):
        module = Path(f"{self.build_folder('modules')}/spi-loopback-test.ko")
        if not self.spi or not module.exists():
            raise Skipped("there is no SPI bus")
        command("insmod", module, "loopback=1", seconds=120)
        lines = [line for line in command("dmesg").splitlines() if "spi-loopback-test" in line]
        assert lines and not any("FAIL" in line.upper() or "error" in line for line in lines), "\n".join(lines[-20:])
        assert any("Finished spi-loopback-tests with return: 0" in line for line in lines), "\n".join(lines[-20:])


class GpioRecord:
    """What the kernel tells the chip, with its own time stamps: probes in the functions of
    gpio-sim."""

    TRACING = Path("/sys/kernel/debug/tracing")
    PROBES = (
        "p:qtplc/set gpio_sim_set offset=%si:u32 value=%dx:s32",
        "p:qtplc/set_multiple gpio_sim_set_multiple mask=+0(%si):x64 bits=+0(%dx):x64",
    )

    def __enter__(self):
        (self.TRACING / "kprobe_events").write_text("\n".join(self.PROBES) + "\n")
        (self.TRACING / "trace_clock").write_text("mono")
        (self.TRACING / "trace").write_text("")
        (self.TRACING / "events/qtplc/enable").write_text("1")
        return self

    def __exit__(self, kind, error, trace):
        if error is not None:
            print((self.TRACING / "trace").read_text()[-2000:])
        (self.TRACING / "events/qtplc/enable").write_text("0")
        (self.TRACING / "kprobe_events").write_text("")

    def low_since(self, line):
        """Since when the line has been set low [s, monotonic clock]; None: it is not, or it was
        before the record."""
        since = None
        for entry in (self.TRACING / "trace").read_text().splitlines():
            time = re.search(r"\s(\d+\.\d+): (set|set_multiple): ", entry)
            level = self.level(entry, line) if time else None
            if level == 1:
                since = None
            elif level == 0 and since is None:
                since = float(time[1])
        return since

    @staticmethod
    def level(entry, line):
        single = re.search(r"offset=(\d+) value=(-?\d+)", entry)
        if single:
            return int(single[2] != "0") if int(single[1]) == line else None
        several = re.search(r"mask=(0x[0-9a-f]+) bits=(0x[0-9a-f]+)", entry)
        mask, bits = (int(several[i], 16) for i in (1, 2))
        return bits >> line & 1 if mask >> line & 1 else None


def transfer(device, sent):
    """One transfer over spidev."""
    received = bytearray(len(sent))
    source = bytearray(sent)
    addresses = [ctypes.addressof((ctypes.c_char * len(sent)).from_buffer(data)) for data in (source, received)]
    message = bytearray(SPI_TRANSFER.pack(addresses[0], addresses[1], len(sent), 100000, 0, 8, 0, 0, 0, 0, 0))
    request = 1 << 30 | SPI_TRANSFER.size << 16 | ord("k") << 8 | 0  # SPI_IOC_MESSAGE(1)
    with open(device, "rb+", buffering=0) as file:
        fcntl.ioctl(file, request, message)
    return bytes(received)
