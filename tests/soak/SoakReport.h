// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Gates.h"

#include <QtCore/QJsonObject>

namespace soak {

/// What came out of a run, for people and for programs.
struct SoakReport
{
    QString profile;
    quint64 seed = 0;
    int seconds = 0;
    QString error;  // why the run ended early; empty: it did not
    QString folder;
    Evidence evidence;
    std::vector<Gate> gates;

    bool passed() const;
    /// The command that does the same again.
    QString command() const;
    QJsonObject toJson() const;
    QString toText() const;
};

}  // namespace soak
