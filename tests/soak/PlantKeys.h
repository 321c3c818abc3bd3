// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

namespace soak {

/// Keys of a secured plant: one for each node, one for an operator, one for an observer, and one
/// that the master does not know.
class PlantKeys
{
public:
    /// Makes new ones, in \a folder. \return false, with the sentence in \a error, when they cannot
    /// be written
    static bool write(const QString &folder, int nodes, QString *error);
    /// All keys that the master knows.
    static QString fileIn(const QString &folder);
    static QPlcSecurity ofOperator(const QString &folder);
    static QPlcSecurity ofObserver(const QString &folder);
    /// The name of the operator, and a wrong key.
    static QPlcSecurity ofStranger(const QString &folder);
};

}  // namespace soak
