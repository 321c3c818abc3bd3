// SPDX-License-Identifier: Apache-2.0 OR GPL-2.0-only
// An SPI bus without wires, for tests in a virtual machine: what a program sends comes back, as if
// MOSI were tied to MISO. With the parameter "answer" (bytes, may be changed in
// /sys/module/spi_loop/parameters) a chip answers these in each transfer instead, and zeros behind
// them. Chip select 0 has no driver: bind it to spidev by driver_override. Chip select 1 is for the
// kernel's own spi-loopback-test.
#include <linux/delay.h>
#include <linux/module.h>
#include <linux/platform_device.h>
#include <linux/spi/spi.h>

static unsigned char answer[64];
static int answer_length;
module_param_array(answer, byte, &answer_length, 0644);
MODULE_PARM_DESC(answer, "bytes that the chip answers; none: it sends back what it gets");

static struct platform_device *parent;
static struct spi_controller *bus;

static int spi_loop_transfer(struct spi_controller *controller, struct spi_device *device,
			     struct spi_transfer *transfer)
{
	unsigned long duration = DIV_ROUND_UP_ULL((u64)transfer->len * 8 * 1000000, transfer->speed_hz);

	usleep_range(duration, duration + 100); /* as long as wires would take: the kernel's test looks at the time */
	if (!transfer->rx_buf)
		return 0;
	memset(transfer->rx_buf, 0, transfer->len);
	if (answer_length > 0)
		memcpy(transfer->rx_buf, answer, min_t(size_t, transfer->len, answer_length));
	else if (transfer->tx_buf)
		memcpy(transfer->rx_buf, transfer->tx_buf, transfer->len);
	return 0;
}

static int spi_loop_register_bus(void)
{
	int error;

	bus = spi_alloc_master(&parent->dev, 0);
	if (!bus)
		return -ENOMEM;
	bus->bus_num = -1;
	bus->num_chipselect = 2;
	bus->mode_bits = SPI_CPOL | SPI_CPHA | SPI_CS_HIGH | SPI_LSB_FIRST;
	bus->bits_per_word_mask = SPI_BPW_RANGE_MASK(1, 32);
	bus->max_speed_hz = 50 * 1000 * 1000;
	bus->transfer_one = spi_loop_transfer;
	error = spi_register_controller(bus);
	if (error)
		spi_controller_put(bus);
	return error;
}

static int __init spi_loop_init(void)
{
	struct spi_board_info free_chip = {.modalias = "qtplc-loop", .max_speed_hz = 1000 * 1000};
	struct spi_board_info tested_chip = {.modalias = "spi-loopback-test", .max_speed_hz = 50 * 1000 * 1000,
					     .chip_select = 1};
	int error;

	parent = platform_device_register_simple("spi_loop", PLATFORM_DEVID_NONE, NULL, 0);
	if (IS_ERR(parent))
		return PTR_ERR(parent);
	error = spi_loop_register_bus();
	if (!error && !(spi_new_device(bus, &free_chip) && spi_new_device(bus, &tested_chip))) {
		spi_unregister_controller(bus);
		error = -ENODEV;
	}
	if (error)
		platform_device_unregister(parent);
	return error;
}

static void __exit spi_loop_exit(void)
{
	spi_unregister_controller(bus);
	platform_device_unregister(parent);
}

module_init(spi_loop_init);
module_exit(spi_loop_exit);
MODULE_LICENSE("GPL");
MODULE_DESCRIPTION("SPI bus without wires for the tests of QtPLC");
