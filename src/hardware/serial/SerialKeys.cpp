// SPDX-License-Identifier: Apache-2.0
#include "SerialKeys.h"

#include "QPlcDriverSettings.h"

namespace qplc {

void SerialKeys::read(QPlcDriverSettings &keys, int usualBaud)
{
    device = keys.requiredText(QStringLiteral("device"), QStringLiteral("/dev/ttyUSB0"));
    keys.claim(QStringLiteral("device"), QStringLiteral("serial line ") + device);
    settings.baud = int(keys.integer(QStringLiteral("baud"), usualBaud, 1, 10000000));
    if (!SerialLine::isKnownRate(settings.baud))
        keys.addError(QStringLiteral("baud"),
                      QStringLiteral("%1 is not a rate of a serial line; there are %2")
                          .arg(settings.baud)
                          .arg(SerialLine::knownRates()));
    const QString format = keys.text(QStringLiteral("format"), QStringLiteral("8N1"));
    if (!settings.setFormat(format))
        keys.addError(QStringLiteral("format"),
                      QStringLiteral("'%1' is not a format of a serial line; it is data bits, "
                                     "parity (N, E, O) and stop bits: '8N1', '7E1'")
                          .arg(format));
}

}  // namespace qplc
