// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "formulas/SignalReference.h"

#include <QtCore/QJsonObject>
#include <QtCore/QVector>

namespace qplc {

/// While the key is held, the signal has this value.
struct KeyBinding
{
    int key = 0;  // Qt::Key; 0: none
    SignalReference signal;
    double value = 0.0;

    /// "Left", "W"; empty: none.
    static QString keyName(int key);
    /// 0 when there is no such key.
    static int keyOf(const QString &name);
};

/// The signal follows an axis of a gamepad.
struct AxisBinding
{
    QString axis;  // of axes()
    SignalReference signal;
    double value = 0.0;     // at full deflection to the right or upwards
    double deadZone = 0.1;  // 0 ... 1: deflections that count as none
    double expo = 0.3;      // 0 linear ... 1 cubic: finer about the middle

    /// "LeftX", "LeftY", "RightX", "RightY".
    static QStringList axes();
    /// The part of `value` that a deflection of -1 ... 1 stands for, -1 ... 1.
    double shaped(double deflection) const;
};

/// What keys and axes do. A value type.
///
/// ```json
/// {"keys": [{"key": "Left", "signal": "bodyControlYawSpeed", "value": -40}],
///  "axes": [{"axis": "LeftX", "signal": "bodyControlYawSpeed", "value": 90, "deadZone": 0.1,
///            "expo": 0.3}]}
/// ```
struct ManualBindings
{
    QVector<KeyBinding> keys;
    QVector<AxisBinding> axes;

    static ManualBindings fromJson(const QJsonObject &settings);
    /// Without what is empty.
    QJsonObject toJson() const;
    /// All signals, each one once, in the order in which they are named.
    QVector<SignalReference> signalReferences() const;
};

}  // namespace qplc
