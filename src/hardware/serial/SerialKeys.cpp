// SPDX-License-Identifier: Apache-2.0
#include "SerialKeys.h"

#include "QPlcDriverSettings.h"

namespace qplc {

void SerialKeys::read(QPlcDriverSettings &settings, int usualBaud)
{
    device = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/ttyUSB0"));
    settings.claim(QStringLiteral("device"), QStringLiteral("serial line ") + device);
    line.baud = int(settings.integer(QStringLiteral("baud"), usualBaud, 50, 10000000));
    if (!SerialLine::isUsualRate(line.baud))
        settings.addWarning(
            QStringLiteral("baud"),
            QStringLiteral("%1 is not a usual rate of a serial line, and not every adapter can do it; look "
                           "whether it is right, usual are %2")
                .arg(line.baud)
                .arg(SerialLine::usualRates()));
    line.mode.read(settings);
    const QString format = settings.text(QStringLiteral("format"), QStringLiteral("8N1"));
    if (!line.setFormat(format))
        settings.addError(QStringLiteral("format"),
                          QStringLiteral("'%1' is not a format of a serial line; it is data bits, "
                                         "parity (N, E, O) and stop bits: '8N1', '7E1'")
                              .arg(format));
}

}  // namespace qplc
