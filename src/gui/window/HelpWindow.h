// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QDialog>

class QTextBrowser;

namespace qplc {

/// The documents in a window of their own, with links, back and forward.
class HelpWindow : public QDialog
{
    Q_OBJECT
public:
    explicit HelpWindow(QWidget *parent);

    /// Shows a document of the folder of documents. \return false: the folder is not there
    bool showDocument(const QString &folder, const QString &name);
    QTextBrowser *browser() const { return m_browser; }

private:
    void open(const QUrl &link);

    QTextBrowser *m_browser;
};

}  // namespace qplc
