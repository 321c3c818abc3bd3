// SPDX-License-Identifier: Apache-2.0
#include "AboutWindow.h"

#include <QtWidgets/QApplication>
#include <QtWidgets/QDialogButtonBox>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

namespace {

struct Part
{
    const char *name;
    const char *licence;
    const char *use;
};

/// As docs/design/licences.md.
constexpr Part parts[] = {
    {"QtPLC", "Apache-2.0", QT_TRANSLATE_NOOP("qplc::AboutWindow", "this library and its programs")},
    {"Qt 5", "LGPL-3.0", QT_TRANSLATE_NOOP("qplc::AboutWindow", "linked dynamically, unchanged")},
    {"Qwt", "Qwt License 1.0 (LGPL-2.1)", QT_TRANSLATE_NOOP("qplc::AboutWindow", "linked dynamically, unchanged")},
    {"kissfft", "BSD-3-Clause", QT_TRANSLATE_NOOP("qplc::AboutWindow", "linked dynamically, unchanged")},
    {"muParser", "BSD-2-Clause", QT_TRANSLATE_NOOP("qplc::AboutWindow", "linked dynamically, unchanged")},
    {"libsodium", "ISC", QT_TRANSLATE_NOOP("qplc::AboutWindow", "linked dynamically, unchanged")},
    {"Zstandard", "BSD-3-Clause", QT_TRANSLATE_NOOP("qplc::AboutWindow", "programs with recordings only")},
    {"libgpiod, libmodbus", "LGPL-2.1", QT_TRANSLATE_NOOP("qplc::AboutWindow", "drivers of devices only")},
    {"Eigen 3", "MPL-2.0", QT_TRANSLATE_NOOP("qplc::AboutWindow", "programs of the example only")},
};

}  // namespace

AboutWindow::AboutWindow(QWidget *parent)
    : QDialog(parent)
{
    setObjectName(QStringLiteral("AboutWindow"));
    setWindowTitle(tr("Version and licences"));
    setModal(false);
    auto *label = new QLabel(text());
    label->setTextFormat(Qt::RichText);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    QPushButton *licences = buttons->addButton(tr("More on licences"), QDialogButtonBox::HelpRole);
    QPushButton *qt = buttons->addButton(tr("About Qt"), QDialogButtonBox::HelpRole);
    connect(licences, &QPushButton::clicked, this, &AboutWindow::licencesRequested);
    connect(qt, &QPushButton::clicked, qApp, &QApplication::aboutQt);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::hide);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(20, 16, 20, 12);
    column->setSpacing(14);
    column->addWidget(label);
    column->addWidget(buttons);
    column->setSizeConstraint(QLayout::SetFixedSize);
}

QString AboutWindow::text()
{
    QString rows;
    for (const Part &part : parts)
        rows += QStringLiteral("<tr><td><b>%1</b></td><td style='padding-left:18px'>%2</td>"
                               "<td style='padding-left:18px'>%3</td></tr>")
                    .arg(QString::fromLatin1(part.name), QString::fromLatin1(part.licence), tr(part.use));
    const QString program = QApplication::applicationDisplayName().toHtmlEscaped();
    return QStringLiteral("<h2>%1</h2><p>%2<br>%3</p><table>%4</table><p>%5</p>")
        .arg(program, tr("QtPLC %1, Control Center").arg(QStringLiteral(QTPLC_VERSION)),
             tr("Qt %1 (built with %2)").arg(QString::fromLatin1(qVersion()), QStringLiteral(QT_VERSION_STR)), rows,
             tr("Qt is used under the LGPL, version 3: you may replace the Qt libraries by others of the same "
                "interface. The texts of the licences come with the libraries."));
}

}  // namespace qplc
