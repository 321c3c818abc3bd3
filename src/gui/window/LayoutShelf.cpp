// SPDX-License-Identifier: Apache-2.0
#include "LayoutShelf.h"

#include "DefaultLayout.h"
#include "gui/layout/LayoutJson.h"

#include <algorithm>

namespace qplc {

LayoutShelf::LayoutShelf(LayoutEditor *editor)
    : m_editor(editor)
{
    m_editor->setLayout(defaultLayout());
}

Layout LayoutShelf::first() const
{
    return m_entries.isEmpty() ? defaultLayout() : m_entries.first().layout;
}

bool LayoutShelf::add(const QString &name, const QByteArray &json, QString *error)
{
    QPlcParseError parseError;
    const std::optional<Layout> layout = layoutFromJson(json, &parseError);
    if (!layout) {
        parseError.file = name;
        if (error)
            *error = parseError.toString();
        return false;
    }
    m_entries.append({name, *layout});
    if (m_entries.size() == 1 && m_isUntouched && m_editor->undoStack()->count() == 0)
        m_editor->setLayout(*layout);
    return true;
}

QStringList LayoutShelf::names() const
{
    QStringList names;
    for (const Entry &entry : m_entries)
        names.append(entry.name);
    return names;
}

bool LayoutShelf::show(const QString &name)
{
    const auto found
        = std::find_if(m_entries.begin(), m_entries.end(), [&](const Entry &entry) { return entry.name == name; });
    if (found == m_entries.end())
        return false;
    m_editor->replace(found->layout, QObject::tr("layout '%1'").arg(name));
    return true;
}

void LayoutShelf::reset()
{
    m_editor->replace(first(), QObject::tr("reset of the layout"));
}

bool LayoutShelf::open(const QString &fileName, QString *error)
{
    QPlcParseError parseError;
    const std::optional<Layout> layout = readLayoutFile(fileName, &parseError);
    if (!layout) {
        if (error)
            *error = parseError.toString();
        return false;
    }
    m_editor->replace(*layout, QObject::tr("opening of a layout"));
    return true;
}

bool LayoutShelf::save(const QString &fileName, QString *error) const
{
    return writeLayoutFile(m_editor->layout(), fileName, error);
}

bool LayoutShelf::restore(const QByteArray &json)
{
    const std::optional<Layout> layout = layoutFromJson(json);
    if (!layout)
        return false;
    m_isUntouched = false;
    m_editor->setLayout(*layout);
    return true;
}

}  // namespace qplc
