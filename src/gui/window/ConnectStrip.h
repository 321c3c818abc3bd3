// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"
#include "node/session/MasterFinder.h"

#include <QtWidgets/QWidget>

class QHBoxLayout;
class QLabel;
class QLineEdit;

namespace qplc {

class BarButton;
class FoundMasters;

/// Asks for the address of a master, over the panels and without stopping anything. Escape closes
/// it.
class ConnectStrip : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the strip
    explicit ConnectStrip(WindowContext *context, QWidget *parent = nullptr);

    void setRecentMasters(const QStringList &addresses);
    void setFoundMasters(const QVector<FoundMaster> &masters);
    /// Shows the strip, with the keys in its field.
    void open();
    void showError(const QString &sentence);
    QLineEdit *addressLine() const { return m_address; }
    QString error() const;

    /// What is wrong with an address; empty: nothing.
    static QString errorOf(const QString &address);

Q_SIGNALS:
    void connectRequested(const QString &address);

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    QWidget *makeFoundRow();
    void choose(const QString &address);
    void accept();

    WindowContext *m_context;
    QLineEdit *m_address;
    QWidget *m_recent;
    QHBoxLayout *m_recentRow;
    BarButton *m_close;
    FoundMasters *m_found;
    QWidget *m_foundRow;
    QLabel *m_error;
};

}  // namespace qplc
