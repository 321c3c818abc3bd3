// SPDX-License-Identifier: Apache-2.0
#include "QPlcReplay.h"

#include "replay/NodeReplay.h"

static_assert(QPlcReplay::Difference::Initial == qplc::ReplayResult::Initial);

QPlcReplay::QPlcReplay(const QString &recording)
    : m_recording(recording)
{
}

bool QPlcReplay::runProgram(const QString &command)
{
    return replay(command, nullptr);
}

bool QPlcReplay::run(QPlcSlaveNode &node)
{
    return replay({}, &node);
}

bool QPlcReplay::replay(const QString &command, QPlcSlaveNode *node)
{
    qplc::ReplayRequest request;
    request.file = m_recording;
    request.program = command;
    request.node = node;
    request.name = m_name;
    request.from = m_from;
    m_result = std::make_shared<qplc::ReplayResult>(qplc::replayNode(request));
    return m_result->kind == qplc::ReplayResult::Done && m_result->compared > 0 && m_result->differences == 0;
}

QString QPlcReplay::text() const
{
    if (!m_result)
        return QStringLiteral("nothing was replayed yet");
    const qplc::ReplayResult &result = *m_result;
    if (!result.error.isEmpty())
        return result.error;
    if (result.first) {
        const QString place = result.first->cycle == Difference::Initial
            ? QStringLiteral("in its initial outputs")
            : QStringLiteral("in cycle %1 (%2 s)").arg(result.first->cycle).arg(result.first->time);
        return QStringLiteral("node '%1' differs in %2 values, first in '%3' %4: recorded %5, computed %6")
            .arg(result.node)
            .arg(result.differences)
            .arg(result.first->signal, place, result.first->recorded, result.first->computed);
    }
    if (result.compared == 0)
        return QStringLiteral("no outputs of node '%1' were compared: from %2 s on, '%3' has none of them")
            .arg(result.node)
            .arg(m_from)
            .arg(m_recording);
    return QStringLiteral("%1 cycles of node '%2' are equal").arg(result.compared).arg(result.node);
}

quint64 QPlcReplay::cycles() const
{
    return m_result ? m_result->cycles : 0;
}

quint64 QPlcReplay::compared() const
{
    return m_result ? m_result->compared : 0;
}

quint64 QPlcReplay::differences() const
{
    return m_result ? m_result->differences : 0;
}

std::optional<QPlcReplay::Difference> QPlcReplay::firstDifference() const
{
    if (!m_result || !m_result->first)
        return std::nullopt;
    const qplc::ReplayResult::Difference &first = *m_result->first;
    return Difference{first.signal, first.cycle, first.time, first.recorded, first.computed};
}
