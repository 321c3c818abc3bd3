// SPDX-License-Identifier: Apache-2.0
#include "ExportedNode.h"

#include <exception>

namespace qplc_export {

bool ExportedNode::make(QString *error)
{
    m_runner.reset();
    try {
        m_node = identity.make();
    } catch (const std::exception &thrown) {
        *error = QStringLiteral("the constructor of the node threw: %1").arg(QString::fromLocal8Bit(thrown.what()));
        return false;
    } catch (...) {
        *error = QStringLiteral("the constructor of the node threw an exception that is not derived from "
                                "std::exception");
        return false;
    }
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(identity.table, &errors, QStringLiteral("signal table"));
    if (!errors.isEmpty()) {
        *error = QPlcParseError::toString(errors);
        return false;
    }
    m_runner = std::make_unique<QPlcNodeRunner>(*m_node);
    if ((identity.period != 0 && !m_runner->setPeriod(std::chrono::nanoseconds(identity.period)))
        || !m_runner->bind(table)) {
        *error = m_runner->errorString();
        return false;
    }
    return true;
}

}  // namespace qplc_export
