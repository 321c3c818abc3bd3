// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DemoPlant.h"

#include <QtCore/QElapsedTimer>
#include <QtPlcGui>
#include <QtWidgets/QAction>

#include <memory>
#include <vector>

namespace awe {

/// The demo in the window: the button of the start page, the connection, and what has to be said of
/// it.
class DemoFlight : public QObject
{
    Q_OBJECT
public:
    /// Adds the commands to \a window, which outlives this object.
    explicit DemoFlight(QPlcControlCenter *window);

    /// "Fly the demo kite". \param clock  runs since the person wanted it
    void begin(const QElapsedTimer &clock);

Q_SIGNALS:
    /// The values of the kite move. \param seconds  since the person wanted it
    void flying(double seconds);
    /// It does not fly, or no more. \param sentence  why, and the remedy
    void failed(const QString &sentence);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void addPlants();
    void fly(const QString &plant);
    void connectWindow(const QString &address);
    void disconnectWindow();
    void watch();
    void showFailure(const QString &sentence);
    void showParts();
    void copyCommands();

    QPlcControlCenter &m_window;
    DemoPlant m_plant;
    QString m_name;     // of the plant in the window; empty: none
    QString m_address;  // to which it is connected
    QAction m_flyAction;
    std::vector<std::unique_ptr<QAction>> m_plantActions;  // of the other plants that have a name
    QAction m_restartAction;
    QAction m_partsAction;
    QAction m_copyAction;
    QElapsedTimer m_clock;
    QTimer m_watch;  // until it flies
};

}  // namespace awe
