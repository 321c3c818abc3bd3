// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalType.h"
#include "QPlcValue.h"
#include "QPlcValueNames.h"

#include <QtCore/QStringList>

#include <optional>

/// The definition of one signal: what the signal table says about it.
///
/// \code
/// QPlcSignalDefinition speed;
/// speed.name = "tetherSpeed";
/// speed.type = QPlcSignalType::Real32;
/// speed.unit = "m/s";
/// speed.minimum = -10.0f;
/// speed.maximum = 10.0f;
/// QPlcSignalTable table;
/// QString error;
/// if (!table.append(speed, &error))
///     qWarning("%s", qPrintable(error));
/// \endcode
///
/// QPlcSignalTable describes the same fields as keys of a file.
///
/// \threadsafe a value type: several threads may read one object
///
/// \ingroup signals
struct QTPLC_EXPORT QPlcSignalDefinition
{
    /// Letter or underscore, then letters, digits, `_` or `.`; at most 63 characters.
    QString name;
    QPlcSignalType type;  ///< type and size of its values
    QString typeName;     ///< type as the table writes it ("Bool", "RealTriple"): a hint for views
    QString unit;         ///< "m/s", "deg"; empty: the signal has no unit
    QString description;  ///< one sentence for people; may be empty
    /// Smallest allowed value of each element, with the type of one element; invalid: no limit.
    QPlcValue minimum;
    /// Largest allowed value of each element, with the type of one element; invalid: no limit.
    QPlcValue maximum;
    /// Value before the first one is written; zero unless set. Always valid in a table.
    QPlcValue initial;
    /// Value after `hold` cycles without a good one; invalid: safeValue() chooses it.
    QPlcValue safe;
    /// Number of cycles, 0 or more, for which the last good value is kept before the safe value
    /// takes its place. Not set: the profile of the plant decides (QPlcProfile): forever in a
    /// simulation, 3 cycles in a plant.
    std::optional<int> hold;
    /// Names of the nodes that may write the signal, the preferred one first; empty: any node.
    QStringList writers;
    bool nanAllowed = false;  ///< NaN counts as a value ("no measurement"); real types only
    /// Names of the values of an integer or boolean signal; empty: no names.
    QPlcValueNames valueNames;
    int line = 0;  ///< line of the section in the file; 0: not read from a file
    /// Largest change of each element per second [unit of the signal/s] when a person or a program
    /// sets the signal from outside, while cycles run. 0: no limit. Real types only.
    double slope = 0.0;
    bool isVolatile = false;  ///< it measures the wall clock: two equal runs give other values

    /// Returns the safe value: `safe` if it is set, else 0, else the limit that is closest to 0.
    /// \pre type is valid
    QPlcValue safeValue() const;
    /// Returns true if every element of \a value lies between minimum and maximum. NaN is in range
    /// only if nanAllowed is set. Without limits the result is always true.
    /// \pre \a value has the type of this signal
    bool isInRange(const QPlcValue &value) const;
    /// Returns the limits for people: "-10 ... 10", "at least 0", "at most 5"; empty without
    /// limits.
    QString rangeText() const;
    /// Returns \a value for people: names of values where there are some ("ReelIn"), else
    /// QPlcValue::toString(). The unit is not part of the text.
    QString textOf(const QPlcValue &value) const;
    /// Reads a value that a person types: a name of a value, or a text that QPlcValue::fromString()
    /// reads.
    /// \param error  if given: why \a text is not a value of this signal, and the names that it
    ///     has; empty on success
    /// \return an invalid value when \a text is not a value of this signal. Limits are not checked:
    ///     see isInRange()
    QPlcValue valueFromText(const QString &text, QString *error = nullptr) const;
};

Q_DECLARE_METATYPE(QPlcSignalDefinition)
