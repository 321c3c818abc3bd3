// SPDX-License-Identifier: Apache-2.0
#include "RingDescription.h"

#include "RosterText.h"

#include <QtCore/QMap>

namespace qplc {

namespace {

const QByteArray ParameterPrefix = QByteArrayLiteral("parameter.");
const QByteArray format = QByteArrayLiteral("qtplc-ring-1");

/// On one line.
QByteArray textOf(const QString &value)
{
    return value.simplified().toUtf8();
}

}  // namespace

QByteArray RingDescription::toText() const
{
    QByteArray text = "format: " + format + '\n';
    const auto add = [&text](const QByteArray &key, const QByteArray &value) {
        text.append(key).append(": ").append(value).append('\n');
    };
    add("plant", textOf(plant));
    add("version", textOf(version));
    add("session", QByteArray::number(session, 16));
    add("phase", QByteArray::number(phase));
    add("period_ns", QByteArray::number(period));
    add("clock", textOf(clock));
    add("scale", QByteArray::number(scale, 'g', 17));
    add("own_signals", rangesText(ownSignals));
    if (!profile.isEmpty())
        add("profile", textOf(profile));
    for (auto parameter = parameters.begin(); parameter != parameters.end(); ++parameter)
        add(ParameterPrefix + parameter.key().toLatin1(), textOf(parameter.value()));
    return text + '\n' + table;
}

bool RingDescription::fromText(const QByteArray &text, RingDescription *description)
{
    const int end = text.indexOf("\n\n");
    if (end < 0)
        return false;
    QMap<QByteArray, QByteArray> values;
    const QList<QByteArray> lines = text.left(end).split('\n');
    for (const QByteArray &line : lines) {
        const int colon = line.indexOf(": ");
        if (colon > 0)
            values.insert(line.left(colon), line.mid(colon + 2));
    }
    *description = {};
    description->plant = QString::fromUtf8(values.value("plant"));
    description->version = QString::fromUtf8(values.value("version"));
    description->session = values.value("session").toULongLong(nullptr, 16);
    description->phase = values.value("phase").toULongLong();
    description->period = values.value("period_ns").toLongLong();
    description->clock = QString::fromUtf8(values.value("clock"));
    description->scale = values.value("scale").toDouble();
    description->ownSignals = signalsIn(values.value("own_signals"));
    description->profile = QString::fromUtf8(values.value("profile"));
    for (auto value = values.lowerBound(ParameterPrefix); value != values.end(); ++value) {
        if (value.key().startsWith(ParameterPrefix))
            description->parameters.insert(QString::fromLatin1(value.key().mid(ParameterPrefix.size())),
                                           QString::fromUtf8(value.value()));
    }
    description->table = text.mid(end + 2);
    return values.value("format") == format && description->period > 0;
}

}  // namespace qplc
