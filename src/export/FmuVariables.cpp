// SPDX-License-Identifier: Apache-2.0
#include "FmuVariables.h"

namespace qplc_export {

namespace {

using Type = QPlcSignalType;

/// Its initial value has to be one of them.
bool isEnumeration(const QPlcSignalDefinition &signal)
{
    if (signal.valueNames.isEmpty() || !signal.type.isInteger() || signal.typeName == QLatin1String("Bool"))
        return false;
    for (int element = 0; element < signal.type.count(); ++element) {
        if (signal.valueNames.nameOf(signal.initial.toInt64(element)).isEmpty())
            return false;
    }
    return true;
}

/// An Integer of FMI 2 has 32 bits and a sign; a Real holds other integers up to 2^53.
FmuVariable::Kind kindOf(const QPlcSignalDefinition &signal, Standard standard)
{
    const bool isOld = standard == Standard::Fmi2;
    if (signal.typeName == QLatin1String("Bool"))
        return FmuVariable::Boolean;
    if (isEnumeration(signal))
        return FmuVariable::Enumeration;
    switch (signal.type.scalar()) {
    case Type::Int8:
        return isOld ? FmuVariable::Integer : FmuVariable::Int8;
    case Type::Int16:
        return isOld ? FmuVariable::Integer : FmuVariable::Int16;
    case Type::Int32:
        return isOld ? FmuVariable::Integer : FmuVariable::Int32;
    case Type::UInt8:
        return isOld ? FmuVariable::Integer : FmuVariable::UInt8;
    case Type::UInt16:
        return isOld ? FmuVariable::Integer : FmuVariable::UInt16;
    case Type::UInt32:
        return isOld ? FmuVariable::Real : FmuVariable::UInt32;
    case Type::UInt64:
        return isOld ? FmuVariable::Real : FmuVariable::UInt64;
    case Type::Int64:
    case Type::DateTime:
        return isOld ? FmuVariable::Real : FmuVariable::Int64;
    case Type::Real32:
        return isOld ? FmuVariable::Real : FmuVariable::Float32;
    case Type::String:
        return FmuVariable::String;
    case Type::Real64:
    case Type::Invalid:
        break;
    }
    return isOld ? FmuVariable::Real : FmuVariable::Float64;
}

void add(std::vector<FmuVariable> *variables, const ExportedNode &node, QPlcSignalIndex index, Standard standard)
{
    const QPlcSignalDefinition &signal = node.signal(index);
    FmuVariable variable{
        signal.name,          index, 0, signal.type.count(), kindOf(signal, standard), node.runner().isInput(index),
        node.isSetting(index)};
    if (standard == Standard::Fmi3 || !signal.type.isArray()) {
        variables->push_back(variable);
        return;
    }
    variable.count = 1;
    for (; variable.element < signal.type.count(); ++variable.element) {
        variable.name = QStringLiteral("%1[%2]").arg(signal.name).arg(variable.element + 1);
        variables->push_back(variable);
    }
}

}  // namespace

std::vector<FmuVariable> variablesOf(const ExportedNode &node, Standard standard)
{
    std::vector<FmuVariable> variables;
    for (const QPlcSignalIndex index : node.runner().inputs())
        add(&variables, node, index, standard);
    for (const QPlcSignalIndex index : node.runner().outputs())
        add(&variables, node, index, standard);
    return variables;
}

QString nameOf(FmuVariable::Kind kind)
{
    static constexpr const char *names[]
        = {"Float32", "Float64", "Int8", "Int16",   "Int32",   "Int64",       "UInt8", "UInt16",
           "UInt32",  "UInt64",  "Real", "Integer", "Boolean", "Enumeration", "String"};
    return QLatin1String(names[kind]);
}

}  // namespace qplc_export
