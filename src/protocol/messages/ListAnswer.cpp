// SPDX-License-Identifier: Apache-2.0
#include "ListAnswer.h"

#include "protocol/ControlFrame.h"

#include <QtCore/QJsonDocument>

namespace qplc::messages {

namespace {

constexpr int PortionSize = 16 * 1024;  // [byte] about the work of half a millisecond

QByteArray textOf(const QJsonObject &object)
{
    return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

}  // namespace

ListAnswer::ListAnswer(QPlcMessage::Kind kind, const QString &tooLong, const QJsonObject &head, const char *list,
                       std::size_t count, Entry entry)
    : m_kind(kind)
    , m_tooLong(tooLong)
    , m_count(count)
    , m_entry(std::move(entry))
    , m_json(textOf(head))
{
    m_json.chop(1);  // the brace at the end
    m_json += QByteArray(head.isEmpty() ? "\"" : ",\"") + list + "\":[";
}

bool ListAnswer::makePortion()
{
    const int end = m_json.size() + PortionSize;
    for (; m_made < m_count && m_json.size() < end && !isTooLong(); ++m_made)
        m_json += (m_made > 0 ? "," : "") + textOf(m_entry(m_made));
    if (m_made < m_count && !isTooLong())
        return false;
    m_json += "]}";
    return true;
}

bool ListAnswer::isTooLong() const
{
    return m_json.size() >= int(UsualControlFrame);
}

}  // namespace qplc::messages
