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

    bool isConnected() const;
    /// Why there is none, as a sentence; empty: there is one.
    QString absence() const;

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
