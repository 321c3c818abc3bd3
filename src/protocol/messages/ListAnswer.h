// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MessageTable.h"

#include <QtCore/QByteArray>

#include <functional>
#include <memory>
#include <type_traits>

namespace qplc::messages {

/// A long answer that is made in portions, so that others are served between them: the fields of a
/// message with one list of objects.
class ListAnswer
{
public:
    /// Makes the entry of a list.
    using Entry = std::function<QJsonObject(std::size_t index)>;

    /// \param tooLong  what the asker is told when the answer does not fit into a message
    /// \param head  the other fields
    ListAnswer(QPlcMessage::Kind kind, const QString &tooLong, const QJsonObject &head, const char *list,
               std::size_t count, Entry entry);

    /// Makes some entries. \return whether the answer is complete, or too long
    bool makePortion();
    bool isTooLong() const;
    QPlcMessage::Kind kind() const { return m_kind; }
    const QString &tooLong() const { return m_tooLong; }
    /// The fields of the message.
    QByteArray json() const { return m_json; }

private:
    QPlcMessage::Kind m_kind;
    QString m_tooLong;
    std::size_t m_count;
    Entry m_entry;
    std::size_t m_made = 0;
    QByteArray m_json;
};

/// An answer with the fields of \a head and \a count entries of \a list, which \a entry makes.
template<typename Message, typename Owner, typename Elements, typename MakeElement>
std::unique_ptr<ListAnswer> makeListAnswer(const Message &head, Elements Owner::*list, std::size_t count,
                                           MakeElement entry, const QString &tooLong)
{
    const char *name = nullptr;
    const auto look = [&](const auto &field) {
        if constexpr (std::is_same_v<std::decay_t<decltype(field.member)>, Elements Owner::*>)
            name = field.member == list ? field.name : name;
    };
    Message::fields.forEach(look);
    QJsonObject others = toObject(head);
    others.remove(QLatin1String(name));
    return std::make_unique<ListAnswer>(kindOf<Message>(), tooLong, others, name, count,
                                        [entry](std::size_t i) { return toObject(entry(i)); });
}

}  // namespace qplc::messages
