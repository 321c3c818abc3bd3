// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalType.h"
#include "QPlcValue.h"
#include "QPlcValueNames.h"

#include <QtCore/QStringList>

#include <optional>

/// What the signal table says of one plc signal.
struct QTPLC_EXPORT QPlcSignalDefinition
{
    QString name;
    QPlcSignalType type;
    QString typeName;  ///< as written in the table ("Bool", "RealTriple"): a hint for views
    QString unit;      ///< "m/s", "deg"; empty: none
    QString description;
    QPlcValue minimum;  ///< smallest allowed value of each element; invalid: none. Type: that of one element
    QPlcValue maximum;  ///< largest allowed value of each element; invalid: none
    QPlcValue initial;  ///< value before the first writer; always valid, zero unless said
    QPlcValue safe;     ///< value when there is no good one for longer than `hold`; invalid: see safeValue()
    std::optional<int>
        hold;  ///< cycles for which the last good value is kept before the safe one, >= 0; none: as the profile of the plant says (QPlcProfile)
    QStringList writers;        ///< names of the nodes that may write it, the preferred one first; empty: any one
    bool nanAllowed = false;    ///< NaN is a value like others: "no measurement". Real types only
    QPlcValueNames valueNames;  ///< of an integer or boolean signal, and of its elements; empty: none
    int line = 0;               ///< line of the section in the file, 0: not from a file
    double slope
        = 0.0;  ///< most that a value from outside moves the signal in a second, in each element; 0: no limit. Real types only

    /// The value that harms least: `safe`, else 0, else the limit that is nearest to 0. \pre the type is valid
    QPlcValue safeValue() const;
    /// Whether every element of \a value, which has this type, is a number within minimum and maximum (or NaN where that is allowed); without limits always true.
    bool isInRange(const QPlcValue &value) const;
    /// "-10 ... 10", "at least 0", "at most 5"; empty without limits.
    QString rangeText() const;
    /// A value of this signal for people: with names where it has names ("ReelIn"), else as QPlcValue::toString().
    QString textOf(const QPlcValue &value) const;
    /// Reads a value: names where there are names, and everything that QPlcValue::fromString() reads. \return invalid when the text is no value, with the reason in \a error
    QPlcValue valueFromText(const QString &text, QString *error = nullptr) const;
};

Q_DECLARE_METATYPE(QPlcSignalDefinition)
