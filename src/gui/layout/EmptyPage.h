// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DropZone.h"

#include <QtCore/QMimeData>

class QPushButton;

namespace qplc {

/// What a tab without panels shows: how to begin.
class EmptyPage : public QWidget
{
    Q_OBJECT
public:
    explicit EmptyPage(QWidget *parent = nullptr);
    QPushButton *addButton() const { return m_add; }

Q_SIGNALS:
    void signalsDropped(const QMimeData *data);

protected:
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dragLeaveEvent(QDragLeaveEvent *event) override;
    void dropEvent(QDropEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    QPushButton *m_add;
    DropOverlay *m_overlay = nullptr;
};

}  // namespace qplc
