// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "formulas/SignalReference.h"

#include <QtCore/QJsonObject>

#include <optional>

namespace qplc {

/// What makes a setter what it is. A value type.
struct SetterSettings
{
    SignalReference signal;
    QString style = QStringLiteral("number");
    std::optional<double> minimum;
    std::optional<double> maximum;
    std::optional<double> on;       // of the toggle; else 1
    std::optional<double> pressed;  // of the momentary button; else the maximum
    QJsonObject generator;          // as GeneratorView reads it

    /// Keys that are missing have their defaults: so undo brings them back.
    static SetterSettings fromJson(const QJsonObject &settings);
    /// Without defaults.
    QJsonObject toJson() const;
    /// \a settings without what a setter knows.
    static QJsonObject unknownOf(QJsonObject settings);
};

}  // namespace qplc
