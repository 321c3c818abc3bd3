// SPDX-License-Identifier: Apache-2.0
#include "FmuWiring.h"

#include "signals/MessageText.h"

#include <QtCore/QRegularExpression>
#include <QtCore/QSet>

#include <algorithm>

namespace qplc {

namespace {

/// "r[1,2]": "r" and 1, 2.
bool splitIndex(const QString &name, QString *array, QVector<int> *index)
{
    static const QRegularExpression pattern(QStringLiteral(R"(^(.+)\[(\d{1,6}(?:,\s*\d{1,6}){0,5})\]$)"));
    const QRegularExpressionMatch match = pattern.match(name);
    if (!match.hasMatch())
        return false;
    *array = match.captured(1);
    const QStringList numbers = match.captured(2).split(QLatin1Char(','));
    for (const QString &number : numbers)
        index->append(number.trimmed().toInt());
    return true;
}

QVector<FmuElement> elementsOf(const FmuVariable &variable)
{
    QVector<FmuElement> elements;
    for (int i = 0; i < variable.count; ++i)
        elements.append({&variable, i});
    return elements;
}

}  // namespace

FmuWiring::FmuWiring(const FmuDescription &description)
    : m_description(description)
{
    for (const FmuVariable &variable : description.variables) {
        QString array;
        Member member{{}, &variable};
        if (variable.isNumber() && variable.count == 1 && splitIndex(variable.name, &array, &member.index))
            m_arrays[array].append(member);
    }
    for (QVector<Member> &members : m_arrays) {
        std::sort(members.begin(), members.end(), [](const Member &a, const Member &b) {
            return std::lexicographical_compare(a.index.begin(), a.index.end(), b.index.begin(), b.index.end());
        });
    }
}

QVector<FmuElement> FmuWiring::find(const QString &name, QString *error) const
{
    const FmuVariable *variable = m_description.find(name);
    if (variable && !variable->isNumber())
        *error = QStringLiteral("%1 is of the type %2, which a signal cannot have; numbers, truth values and "
                                "enumerations fit")
                     .arg(quoted(name), variable->typeText(m_description.version));
    else if (variable && variable->count == 0)
        *error = QStringLiteral("%1 has no elements").arg(quoted(name));
    else if (variable)
        return elementsOf(*variable);
    if (variable)
        return {};
    const auto array = m_arrays.find(name);
    if (array != m_arrays.end()) {
        QVector<FmuElement> elements;
        for (const Member &member : *array)
            elements.append({member.variable, 0});
        return elements;
    }
    QString base;
    QVector<int> index;
    const FmuVariable *whole
        = splitIndex(name, &base, &index) && index.size() == 1 ? m_description.find(base) : nullptr;
    if (whole && whole->isNumber() && whole->count > 1 && index.first() < whole->count)
        return {{whole, index.first()}};
    *error = whole
        ? QStringLiteral("%1 has the elements 0 to %2").arg(quoted(base)).arg(whole->count - 1)
        : QStringLiteral("the FMU has no variable %1%2").arg(quoted(name), didYouMean(m_description.closeNames(name)));
    return {};
}

QStringList FmuWiring::names() const
{
    QStringList names;
    QSet<QString> arrays;
    for (const FmuVariable &variable : m_description.variables) {
        QString array;
        QVector<int> index;
        if (!variable.isNumber() || variable.count == 0)
            continue;
        if (!splitIndex(variable.name, &array, &index) || !m_arrays.contains(array) || m_description.find(array)) {
            names << variable.name;
        } else if (!arrays.contains(array)) {
            arrays.insert(array);
            names << array;
        }
    }
    return names;
}

}  // namespace qplc
