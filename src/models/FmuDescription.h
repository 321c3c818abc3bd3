// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcParseError.h"
#include "QPlcSignalType.h"

#include <QtCore/QHash>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <array>
#include <optional>

namespace qplc {

/// A variable of an FMU, as its modelDescription.xml says.
struct FmuVariable
{
    /// Which functions read and write it.
    enum Kind : quint8 {
        Float32,
        Float64,
        Int8,
        UInt8,
        Int16,
        UInt16,
        Int32,
        UInt32,
        Int64,
        UInt64,
        Boolean,
        String,
        Binary,  // not offered
        Clock    // not offered
    };
    static constexpr int KindCount = Clock + 1;
    enum Causality : quint8 { Local, Input, Output, Parameter, CalculatedParameter, StructuralParameter, Independent };
    enum Variability : quint8 { Constant, Fixed, Tunable, Discrete, Continuous };

    QString name;
    quint32 reference = 0;
    Kind kind = Float64;
    bool isEnumeration = false;
    Causality causality = Local;
    Variability variability = Continuous;
    QString initial;  // "exact", "approx", "calculated"; empty: the standard decides
    QString start;    // numbers are separated by spaces
    QString unit;
    QString description;
    QString minimum;
    QString maximum;
    QString typeName;                       // declared type
    QVector<QPair<qint64, QString>> items;  // of an enumeration
    QVector<int> dimensions;                // at the start values of structural parameters; empty: a scalar
    int count = 1;                          // of its elements
    int line = 0;                           // of modelDescription.xml

    bool isNumber() const { return kind <= Boolean; }
    /// What an element is in memory. \param version  of FMI
    QPlcSignalType::Scalar scalar(int version) const;
    /// Whether a node may set it while cycles run.
    bool isSettable() const { return causality == Input || (causality == Parameter && variability == Tunable); }
    /// Whether it has a start value that can be changed.
    bool hasStart() const;
    /// "Float64[3]", "Boolean", "Enumeration", "Integer": as the standard calls it. \param version
    /// of FMI
    QString typeText(int version) const;
    /// "input", "output", ...
    QString causalityText() const;
};

/// The content of a modelDescription.xml: what an FMU is, and its variables.
class FmuDescription
{
public:
    static constexpr int LargestText = 64 * 1024 * 1024;  // [byte]
    static constexpr int LargestDepth = 32;               // elements inside of each other
    static constexpr int MostAttributes = 256;            // of an element
    static constexpr int MostVariables = 250'000;
    static constexpr int MostElements = 1'000'000;  // of all variables together

    /// Reads \a text. \return an invalid description, with the first \a error, when it is not
    /// valid, or describes something that is not offered
    static FmuDescription fromXml(const QByteArray &text, QPlcParseError *error);

    bool isValid() const { return version != 0; }
    /// The variable with exactly this name; null: there is none.
    const FmuVariable *find(const QString &name) const;
    /// The names of variables that a text may have meant, for a message.
    QStringList closeNames(const QString &name) const;

    int version = 0;  // 2, 3
    QString versionText;
    QString modelName;
    QString token;            // guid, instantiationToken
    QString modelIdentifier;  // name of the library
    QString generationTool;
    QString description;
    std::optional<double> startTime;  // of the default experiment [s]
    std::optional<double> stopTime;
    std::optional<double> tolerance;
    std::optional<double> stepSize;           // [s]
    std::optional<double> fixedInternalStep;  // [s]
    bool needsExecutionTool = false;
    bool handlesVariableStep = false;
    bool onlyOneInstance = false;
    bool hasEventMode = false;
    bool hasCoSimulation = false;
    QStringList otherKinds;  // "model exchange", "scheduled execution"
    QVector<FmuVariable> variables;

private:
    friend class FmuDescriptionReader;
    QHash<QString, int> m_indices;
};

}  // namespace qplc
