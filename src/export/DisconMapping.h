// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ExportedNode.h"
#include "IniText.h"

#include <vector>

namespace qplc_export {

/// Which record of the host is which signal of the node: the file that the host names.
///
///     ; NREL 5 MW
///     [read]
///     generatorSpeed = 20                ; record, from 1
///     windSpeed      = 27 * 0.5          ; value of the signal = value of the record * factor
///     [write]
///     generatorTorque = 47
///     bladePitch      = 42, 43, 44       ; the elements of an array
///     [constant]
///     35 = 1                             ; record = value, in each call
///     [plant]                            ; of a plant: settings in place of those in its library
///     port = 50001
class DisconMapping
{
public:
    struct Entry
    {
        int record = 0;
        double factor = 1.0;
        QPlcSignalIndex signal = QPlcInvalidSignalIndex;
        int element = 0;
    };
    struct Constant
    {
        int record = 0;
        double value = 0.0;
    };

    /// \return false, with file, line and remedy in \a error
    bool read(const QString &fileName, ExportedNode &node, QString *error);
    const std::vector<Entry> &inputs() const { return m_inputs; }
    const std::vector<Entry> &outputs() const { return m_outputs; }
    const std::vector<Constant> &constants() const { return m_constants; }

private:
    bool addLine(const IniLine &line, ExportedNode &node, QString *error);
    bool addSignal(bool isInput, const QString &name, const QString &records, const ExportedNode &node, QString *error);
    bool addConstant(const QString &record, const QString &value, QString *error);
    bool mayWrite(int record, QString *error) const;

    std::vector<Entry> m_inputs;
    std::vector<Entry> m_outputs;
    std::vector<Constant> m_constants;
};

}  // namespace qplc_export
