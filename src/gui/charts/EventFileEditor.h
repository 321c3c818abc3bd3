// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "EventFiles.h"

#include <QtWidgets/QWidget>

class QCheckBox;
class QLineEdit;
class QSpinBox;

namespace qplc {

/// Whether, where, and how many events are saved: a few lines in the menu of a trigger.
class EventFileEditor : public QWidget
{
    Q_OBJECT
public:
    explicit EventFileEditor(QWidget *parent = nullptr);

    const EventFileSettings &settings() const { return m_settings; }
    void show(const EventFileSettings &settings);

Q_SIGNALS:
    /// By a person.
    void edited();

private:
    void take();
    void chooseFolder();

    EventFileSettings m_settings;
    QCheckBox *m_on;
    QLineEdit *m_folder;
    QSpinBox *m_most;
};

}  // namespace qplc
