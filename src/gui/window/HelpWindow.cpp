// SPDX-License-Identifier: Apache-2.0
#include "HelpWindow.h"

#include <QtCore/QFileInfo>
#include <QtGui/QDesktopServices>
#include <QtWidgets/QAction>
#include <QtWidgets/QTextBrowser>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

HelpWindow::HelpWindow(QWidget *parent)
    : QDialog(parent)
    , m_browser(new QTextBrowser)
{
    setObjectName(QStringLiteral("HelpWindow"));
    setWindowTitle(tr("Documentation"));
    setModal(false);
    m_browser->setOpenLinks(false);
    m_browser->setFrameShape(QFrame::NoFrame);
    m_browser->document()->setDocumentMargin(16);
    m_browser->setAccessibleName(tr("Documentation"));
    auto *bar = new QHBoxLayout;
    bar->setContentsMargins(6, 4, 6, 4);
    const auto add = [&](const QString &text, const QKeySequence &keys, void (QTextBrowser::*slot)(),
                         void (QTextBrowser::*available)(bool)) {
        auto *action = new QAction(text, this);
        auto *button = new QToolButton;
        button->setDefaultAction(action);
        button->setAutoRaise(true);
        button->setFocusPolicy(Qt::TabFocus);
        bar->addWidget(button);
        action->setShortcut(keys);
        action->setEnabled(available == nullptr);
        connect(action, &QAction::triggered, m_browser, slot);
        if (available)
            connect(m_browser, available, action, &QAction::setEnabled);
    };
    add(tr("Back"), QKeySequence(QKeySequence::Back), &QTextBrowser::backward, &QTextBrowser::backwardAvailable);
    add(tr("Forward"), QKeySequence(QKeySequence::Forward), &QTextBrowser::forward, &QTextBrowser::forwardAvailable);
    add(tr("First page"), QKeySequence(int(Qt::ALT) | int(Qt::Key_Home)), &QTextBrowser::home, nullptr);
    bar->addStretch(1);
    connect(m_browser, &QTextBrowser::anchorClicked, this, &HelpWindow::open);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(bar);
    column->addWidget(m_browser, 1);
    resize(900, 640);
}

bool HelpWindow::showDocument(const QString &folder, const QString &name)
{
    const QString file = folder + QLatin1Char('/') + name;
    if (folder.isEmpty() || !QFileInfo::exists(file))
        return false;
    m_browser->setSource(QUrl::fromLocalFile(file), QTextDocument::MarkdownResource);
    m_browser->clearHistory();
    show();
    raise();
    activateWindow();
    return true;
}

/// Documents are shown here; the rest by the desktop.
void HelpWindow::open(const QUrl &link)
{
    const QUrl target = m_browser->source().resolved(link);
    const QString file = target.toLocalFile();
    if (target.isLocalFile() && file.endsWith(QLatin1String(".md")) && QFileInfo::exists(file))
        m_browser->setSource(target, QTextDocument::MarkdownResource);
    else if (target.adjusted(QUrl::RemoveFragment) == m_browser->source().adjusted(QUrl::RemoveFragment))
        m_browser->setSource(target);
    else
        QDesktopServices::openUrl(target);
}

}  // namespace qplc
