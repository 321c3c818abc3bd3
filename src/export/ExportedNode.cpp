// SPDX-License-Identifier: Apache-2.0
#include "ExportedNode.h"

#include <exception>
#include <vector>

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
    m_plant = dynamic_cast<HeldPlant *>(m_node.get());
    QVector<QPlcParseError> errors;
    QPlcSignalTable table = QPlcSignalTable::fromIni(identity.table, &errors, QStringLiteral("signal table"));
    if (!errors.isEmpty()) {
        *error = QPlcParseError::toString(errors);
        return false;
    }
    if (m_plant && !m_plant->prepare(table, &table, error))
        return false;
    m_runner = std::make_unique<QPlcNodeRunner>(*m_node);
    if ((identity.period != 0 && !m_runner->setPeriod(std::chrono::nanoseconds(identity.period)))
        || !m_runner->bind(table)) {
        *error = m_runner->errorString();
        return false;
    }
    return true;
}

bool ExportedNode::open(QString *error)
{
    if (!m_plant)
        return true;
    if (!m_plant->open(*m_runner, error))
        return false;
    const QVector<QPlcSignalIndex> inputs = m_runner->inputs();
    std::vector<QByteArray> given;
    for (const QPlcSignalIndex input : inputs)
        given.emplace_back(m_runner->bytes(input), signal(input).type.size());
    if (!m_runner->reset()) {
        *error = m_runner->errorString();
        return false;
    }
    for (int i = 0; i < inputs.size(); ++i)
        m_runner->setBytes(inputs.at(i), given[std::size_t(i)].constData());
    return true;
}

/// A plant needs no node around it in the sentence, and it does not throw.
QString ExportedNode::failure() const
{
    const QString reason = m_plant ? m_plant->endReason() : QString();
    return reason.isEmpty() ? m_runner->errorString() : reason;
}

bool ExportedNode::setSetting(const QString &key, const QString &text, QString *error)
{
    QPlcValue value;
    if (!m_plant->readSetting(key, text, &value, error))
        return false;
    if (m_runner->set(QLatin1String(SettingPrefix) + key, value))
        return true;
    *error = m_runner->errorString();
    return false;
}

}  // namespace qplc_export
