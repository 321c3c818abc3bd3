// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QDialog>

namespace qplc {

/// The version, and the licences of QtPLC and of all that the program is made of.
class AboutWindow : public QDialog
{
    Q_OBJECT
public:
    explicit AboutWindow(QWidget *parent);

    /// As HTML.
    static QString text();

Q_SIGNALS:
    /// A person wants to read the page about licences.
    void licencesRequested();
};

}  // namespace qplc
