// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QDialog>

class QAction;
class QTreeWidget;

namespace qplc {

/// All keys of the window at a glance, beside what one does.
class KeysWindow : public QDialog
{
    Q_OBJECT
public:
    explicit KeysWindow(QWidget *parent);

    struct Group
    {
        QString name;
        QList<QAction *> actions;  // those without keys are left out
    };
    void showKeys(const QVector<Group> &groups);
    /// "Ctrl+K" of everything that is listed.
    QStringList keys() const;

private:
    QTreeWidget *m_list;
};

}  // namespace qplc
