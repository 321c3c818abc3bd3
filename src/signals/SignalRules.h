// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalDefinition.h"

#include <QtCore/QStringList>

namespace qplc {

/// The keys of a signal in its table. Name: the section itself.
enum class SignalKey : quint8 {
    Type,
    Unit,
    Description,
    Minimum,
    Maximum,
    Initial,
    Safe,
    Hold,
    Values,
    Writer,
    Nan,
    Slope,
    Volatile,
    Name
};
constexpr int signalKeyCount = int(SignalKey::Name);

/// "type", "unit", ... in the order of SignalKey
const QStringList &signalKeyNames();

/// The type of one element of \a type; a text is its own element.
inline QPlcSignalType elementType(QPlcSignalType type)
{
    return type.isString() ? type : QPlcSignalType(type.scalar());
}

/// "A > B > C"
QString writersText(const QStringList &writers);
/// What stands behind `nan =` where NaN is a value.
inline QString nanAllowedText()
{
    return QStringLiteral("allowed");
}

/// What stands behind `volatile =` where a signal measures the wall clock.
inline QString volatileText()
{
    return QStringLiteral("yes");
}

/// "5 per second"
QString slopeText(double slope);
/// Reads what slopeText() writes. \return 0 when \a text is no slope
double slopeFromText(const QString &text);

/// Section 6.3 of docs/protocol.md: the parameters of \a signal that decide which values are taken,
/// and what takes their place. \pre there are no complaints about it
QByteArray safetyLine(const QPlcSignalDefinition &signal);

struct Complaint
{
    SignalKey key;
    QString text;  // what is wrong, and the remedy
};

/// What makes \a signal no signal of a table; empty: nothing.
QVector<Complaint> complaintsAbout(const QPlcSignalDefinition &signal);

/// Lines of the section of \a signal in an INI text. \pre there are no complaints about it
QString iniSection(const QPlcSignalDefinition &signal);

}  // namespace qplc
