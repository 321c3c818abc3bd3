// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/layout/LayoutEditor.h"

namespace qplc {

/// The layouts that come with a program, and how they, and those of files, get into an editor: as
/// steps that can be undone.
class LayoutShelf
{
public:
    /// \param editor  outlives the shelf
    explicit LayoutShelf(LayoutEditor *editor);

    /// \return false, and \a error says where the text is wrong
    bool add(const QString &name, const QByteArray &json, QString *error);
    QStringList names() const;
    bool show(const QString &name);
    void reset();
    bool open(const QString &fileName, QString *error);
    bool save(const QString &fileName, QString *error) const;
    /// Takes a layout that was there before, so that there is nothing to undo.
    bool restore(const QByteArray &json);

private:
    struct Entry
    {
        QString name;
        Layout layout;
    };

    Layout first() const;

    LayoutEditor *m_editor;
    QVector<Entry> m_entries;
    bool m_isUntouched = true;  // what is shown is first()
};

}  // namespace qplc
