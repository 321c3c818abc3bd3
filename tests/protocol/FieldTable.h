// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/messages/MessageTable.h"

#include <QtCore/QHash>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <typeinfo>

/// The table of section 5.9 of docs/protocol.md, made from the structs of the messages.
namespace fieldtable {

namespace messages = qplc::messages;

template<typename T>
constexpr bool isObject = std::is_base_of_v<messages::WireOfStruct<T>, messages::Wire<T>>;

/// What a value is on the wire: its name there, and of a list or an object with names that are data
/// also its element.
template<typename T>
struct Shape
{
    using Element = T;
    static QString text() { return QLatin1String(messages::Wire<T>::name); }
    static QString path(const QString &name) { return name; }
};
template<typename T>
struct Shape<std::optional<T>> : Shape<T>
{
};
template<typename List, typename T>
struct ListShape
{
    using Element = typename Shape<T>::Element;
    static QString text() { return QStringLiteral("array of %1").arg(Shape<T>::text()); }
    static QString path(const QString &name) { return name + QStringLiteral("[]"); }
};
template<typename T>
struct Shape<std::vector<T>> : ListShape<std::vector<T>, T>
{
};
template<typename T>
struct Shape<QVector<T>> : ListShape<QVector<T>, T>
{
};
template<>
struct Shape<QStringList> : ListShape<QStringList, QString>
{
};
template<typename T>
struct Shape<QMap<QString, T>>
{
    using Element = typename Shape<T>::Element;
    static QString text() { return QStringLiteral("object, name → %1").arg(Shape<T>::text()); }
    static QString path(const QString &name) { return name + QStringLiteral(".*"); }
};

inline QString presenceText(messages::Presence presence)
{
    switch (presence) {
    case messages::Presence::Required:
        return QStringLiteral("required");
    case messages::Presence::Defaulted:
        return QStringLiteral("always sent");
    case messages::Presence::WhenSet:
        return QStringLiteral("optional");
    case messages::Presence::Checked:
        return QStringLiteral("optional, checked");
    }
    return {};
}

/// The texts that an enum can have, or the numbers of a range; empty where the type says all.
template<typename Element>
QString valuesText(const messages::Range &range)
{
    if constexpr (std::is_enum_v<Element>) {
        QStringList names;
        for (const auto &[value, name] : messages::Names<Element>::all)
            names << QStringLiteral("`%1`").arg(QLatin1String(name));
        return names.join(QStringLiteral(", "));
    }
    const messages::Range all;
    if (range.minimum == all.minimum && range.maximum == all.maximum)
        return {};
    return QStringLiteral("%1 … %2").arg(range.minimum, 0, 'g', 17).arg(range.maximum, 0, 'g', 17);
}

/// Adds a row for each field of a struct, and for each of the structs in it.
class Rows
{
public:
    template<typename Message>
    void add()
    {
        m_message = QPlcMessage::kindName(Message::kind);
        m_rows << QString();
        m_known.clear();
        addAll(messages::Description<Message>::fields, QString());
        if (m_rows.last().isEmpty())
            m_rows.last() = QStringLiteral("| `%1` | none | | | |\n").arg(m_message);
    }
    QString text() const { return m_rows.join(QString()); }

private:
    template<typename... Fields>
    void addAll(const messages::FieldList<Fields...> &fields, const QString &path)
    {
        fields.forEach([&](const auto &each) { addOne(each, path); });
    }
    template<typename Owner, typename Value>
    void addOne(const messages::Field<Owner, Value> &field, const QString &path)
    {
        using Element = typename Shape<Value>::Element;
        const QString name = path + QLatin1String(field.name);
        const bool isOneValue = !isObject<Element>;
        const auto known = isOneValue ? m_known.cend() : m_known.constFind(typeid(Element).name());
        const QString values
            = known == m_known.cend() ? valuesText<Element>(field.range) : QStringLiteral("as `%1`").arg(*known);
        addRow(name, Shape<Value>::text(), presenceText(field.presence), values);
        if constexpr (isObject<Element>) {
            if (known == m_known.cend()) {
                m_known.insert(typeid(Element).name(), name);
                addAll(messages::Description<Element>::fields, Shape<Value>::path(name) + QLatin1Char('.'));
            }
        }
    }
    template<typename Owner>
    void addOne(const messages::Rest<Owner> &, const QString &)
    {
        m_rows.last() += QStringLiteral("| `%1` | those of the transport (7.6, 7.7) | | | |\n").arg(m_message);
    }
    void addRow(const QString &name, const QString &type, const QString &presence, const QString &values)
    {
        m_rows.last()
            += QStringLiteral("| `%1` | `%2` | %3 | %4 | %5 |\n").arg(m_message, name, type, presence, values);
    }

    QString m_message;
    QStringList m_rows;
    QHash<QByteArray, QString> m_known;  // structs of this message: where their fields are
};

template<typename... Messages>
QString rowsOf(messages::List<Messages...>)
{
    Rows rows;
    (rows.add<Messages>(), ...);
    return rows.text();
}

/// \param sender  as in "Node or tool"
inline QString tableOf(const QString &sender, const QString &receiver, const QString &rows)
{
    return QStringLiteral("%1 → %2:\n\n| message | field | type | presence | values |\n|---|---|---|---|---|\n%3\n")
        .arg(sender, receiver, rows);
}

inline QString text()
{
    return tableOf(QStringLiteral("Node or tool"), QStringLiteral("master"), rowsOf(messages::FromClient()))
        + tableOf(QStringLiteral("Master"), QStringLiteral("node or tool"), rowsOf(messages::FromMaster()));
}

}  // namespace fieldtable
