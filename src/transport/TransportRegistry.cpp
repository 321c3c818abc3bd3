// SPDX-License-Identifier: Apache-2.0
#include "TransportRegistry.h"

#include <QtCore/QStringList>

#include <algorithm>
#include <limits>
#include <utility>

namespace qplc {

// CMake makes TransportRows.inc: a line QTPLC_TRANSPORT(Name) for each transport of the library.
#define QTPLC_TRANSPORT(Name) std::unique_ptr<const TransportKind> make##Name##Kind();
#include "TransportRows.inc"
#undef QTPLC_TRANSPORT

TransportRegistry &TransportRegistry::instance()
{
    static TransportRegistry registry;
    return registry;
}

TransportRegistry::TransportRegistry()
{
#define QTPLC_TRANSPORT(Name) m_kinds.push_back(make##Name##Kind());
#include "TransportRows.inc"
#undef QTPLC_TRANSPORT
}

bool TransportRegistry::add(std::unique_ptr<const TransportKind> kind, QString *error)
{
    const QString name = kind->name();
    const auto isNameCharacter = [](QChar c) {
        return (c >= QLatin1Char('a') && c <= QLatin1Char('z')) || c.isDigit() || c == QLatin1Char('-');
    };
    if (name.isEmpty() || !std::all_of(name.begin(), name.end(), isNameCharacter)) {
        *error = QStringLiteral("'%1' is not a valid name of a transport; use small letters, digits and '-'").arg(name);
        return false;
    }
    if (named(name)) {
        *error = QStringLiteral("transport '%1' exists already; use another name than %2").arg(name, namesText());
        return false;
    }
    if (m_kinds.size() >= std::numeric_limits<quint8>::max()) {
        *error = QStringLiteral("a program has at most %1 transports").arg(m_kinds.size());
        return false;
    }
    m_kinds.push_back(std::move(kind));
    return true;
}

const TransportKind *TransportRegistry::named(const QString &name) const
{
    return at(numberOf(name));
}

const TransportKind *TransportRegistry::at(int number) const
{
    return number >= 1 && number <= int(m_kinds.size()) ? m_kinds[std::size_t(number) - 1].get() : nullptr;
}

int TransportRegistry::numberOf(const QString &name) const
{
    const auto hasName = [&name](const auto &kind) { return kind->name() == name; };
    const auto found = std::find_if(m_kinds.begin(), m_kinds.end(), hasName);
    return found == m_kinds.end() ? 0 : int(found - m_kinds.begin()) + 1;
}

QString TransportRegistry::namesText(const QString &behind) const
{
    QStringList names;
    for (const auto &kind : m_kinds) {
        if (kind->isAtHand())
            names.append(kind->name() + behind);
    }
    const QString last = names.takeLast();
    return names.join(QLatin1String(", ")) + QStringLiteral(" or ") + last;
}

}  // namespace qplc
