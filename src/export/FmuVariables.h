// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ExportedNode.h"

#include <vector>

namespace qplc_export {

enum class Standard : quint8 { Fmi2 = 2, Fmi3 = 3 };

/// A variable of an FMU: a signal in FMI 3; in FMI 2, which has no arrays, an element of it.
struct FmuVariable
{
    enum Kind : quint8 {
        Float32,
        Float64,
        Int8,
        Int16,
        Int32,
        Int64,
        UInt8,
        UInt16,
        UInt32,
        UInt64,
        Real,     // of FMI 2
        Integer,  // of FMI 2
        Boolean,
        Enumeration,
        String
    };
    QString name;
    QPlcSignalIndex signal = QPlcInvalidSignalIndex;
    int element = 0;  // the first one that it has
    int count = 1;    // of elements
    Kind kind = Real;
    bool isInput = false;
    bool isSetting = false;  // of a plant: an input that is set before the initialization
};

/// Variable i has the value reference i + 1; inputs first, in the order of their declaration.
std::vector<FmuVariable> variablesOf(const ExportedNode &node, Standard standard);
/// "Float64", as the standards write it.
QString nameOf(FmuVariable::Kind kind);
/// The value reference of the time, in FMI 3.
constexpr unsigned TimeReference = 0;

/// The file modelDescription.xml.
QByteArray describe(const ExportedNode &node, Standard standard);
/// The GUID (FMI 2) or instantiation token (FMI 3): computed from the content of the description.
QString tokenOf(const ExportedNode &node, Standard standard);

}  // namespace qplc_export
