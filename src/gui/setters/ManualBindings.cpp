// SPDX-License-Identifier: Apache-2.0
#include "ManualBindings.h"

#include <QtCore/QJsonArray>
#include <QtGui/QKeySequence>

#include <algorithm>
#include <cmath>

namespace qplc {

QString KeyBinding::keyName(int key)
{
    return key == 0 ? QString() : QKeySequence(key).toString(QKeySequence::PortableText);
}

int KeyBinding::keyOf(const QString &name)
{
    const QKeySequence sequence = QKeySequence::fromString(name, QKeySequence::PortableText);
    const int key = sequence.count() == 1 ? sequence[0] : 0;
    return key == Qt::Key_unknown || (key & int(Qt::KeyboardModifierMask)) != 0 ? 0 : key;
}

QStringList AxisBinding::axes()
{
    return {QStringLiteral("LeftX"), QStringLiteral("LeftY"), QStringLiteral("RightX"), QStringLiteral("RightY")};
}

double AxisBinding::shaped(double deflection) const
{
    const double size = std::min(std::abs(deflection), 1.0);
    if (!(size > deadZone))  // NaN, too
        return 0.0;
    const double used = (size - deadZone) / (1.0 - deadZone);
    const double share = (1.0 - expo) * used + expo * used * used * used;
    return std::copysign(share, deflection);
}

namespace {

SignalReference signalOf(const QJsonValue &row)
{
    return SignalReference::fromString(row[QStringLiteral("signal")].toString());
}

AxisBinding axisOf(const QJsonValue &row)
{
    constexpr double largestDeadZone = 0.9;
    AxisBinding of;
    of.axis = row[QStringLiteral("axis")].toString();
    of.signal = signalOf(row);
    of.value = row[QStringLiteral("value")].toDouble();
    of.deadZone = qBound(0.0, row[QStringLiteral("deadZone")].toDouble(of.deadZone), largestDeadZone);
    of.expo = qBound(0.0, row[QStringLiteral("expo")].toDouble(of.expo), 1.0);
    return of;
}

QJsonObject rowOf(const AxisBinding &axis)
{
    const AxisBinding plain;
    QJsonObject row{{QStringLiteral("axis"), axis.axis},
                    {QStringLiteral("signal"), axis.signal.toString()},
                    {QStringLiteral("value"), axis.value}};
    if (axis.deadZone != plain.deadZone)
        row.insert(QStringLiteral("deadZone"), axis.deadZone);
    if (axis.expo != plain.expo)
        row.insert(QStringLiteral("expo"), axis.expo);
    return row;
}

}  // namespace

ManualBindings ManualBindings::fromJson(const QJsonObject &settings)
{
    ManualBindings bindings;
    const QJsonArray keys = settings.value(QStringLiteral("keys")).toArray();
    for (const QJsonValue &row : keys)
        bindings.keys.append({KeyBinding::keyOf(row[QStringLiteral("key")].toString()), signalOf(row),
                              row[QStringLiteral("value")].toDouble()});
    const QJsonArray axes = settings.value(QStringLiteral("axes")).toArray();
    for (const QJsonValue &row : axes)
        bindings.axes.append(axisOf(row));
    return bindings;
}

QJsonObject ManualBindings::toJson() const
{
    QJsonArray keyRows;
    for (const KeyBinding &key : keys)
        keyRows.append(QJsonObject{{QStringLiteral("key"), KeyBinding::keyName(key.key)},
                                   {QStringLiteral("signal"), key.signal.toString()},
                                   {QStringLiteral("value"), key.value}});
    QJsonArray axisRows;
    for (const AxisBinding &axis : axes)
        axisRows.append(rowOf(axis));
    QJsonObject json;
    if (!keyRows.isEmpty())
        json.insert(QStringLiteral("keys"), keyRows);
    if (!axisRows.isEmpty())
        json.insert(QStringLiteral("axes"), axisRows);
    return json;
}

QVector<SignalReference> ManualBindings::signalReferences() const
{
    QVector<SignalReference> references;
    const auto add = [&references](const SignalReference &reference) {
        if (reference.isValid() && !references.contains(reference))
            references.append(reference);
    };
    for (const KeyBinding &key : keys)
        add(key.signal);
    for (const AxisBinding &axis : axes)
        add(axis.signal);
    return references;
}

}  // namespace qplc
