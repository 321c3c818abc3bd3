// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>

#include <memory>

namespace qplc {

/// The first gamepad that is plugged in, now or later. Without Qt Gamepad there is never one.
class Gamepad : public QObject
{
    Q_OBJECT
public:
    explicit Gamepad(QObject *parent = nullptr);
    ~Gamepad() override;

    /// Whether this library can see gamepads at all.
    static bool isSupported();
    bool isConnected() const;

Q_SIGNALS:
    void connectedChanged();
    /// \param axis  of AxisBinding::axes()  \param deflection  -1 ... 1, to the right and upwards
    void axisMoved(const QString &axis, double deflection);
    /// The lower one of the four buttons was pressed: it arms and disarms the axes.
    void armPressed();

private:
    struct Private;
    std::unique_ptr<Private> d;
};

}  // namespace qplc
