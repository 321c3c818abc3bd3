// SPDX-License-Identifier: Apache-2.0
#include "Gamepad.h"

#ifdef QTPLC_HAS_GAMEPAD
#include <QtGamepad/QGamepadManager>

namespace qplc {

namespace {

QString axisName(QGamepadManager::GamepadAxis axis)
{
    switch (axis) {
    case QGamepadManager::AxisLeftX:
        return QStringLiteral("LeftX");
    case QGamepadManager::AxisLeftY:
        return QStringLiteral("LeftY");
    case QGamepadManager::AxisRightX:
        return QStringLiteral("RightX");
    case QGamepadManager::AxisRightY:
        return QStringLiteral("RightY");
    default:
        return {};
    }
}

bool pointsDown(QGamepadManager::GamepadAxis axis)
{
    return axis == QGamepadManager::AxisLeftY || axis == QGamepadManager::AxisRightY;
}

}  // namespace

struct Gamepad::Private
{
    QGamepadManager *manager = QGamepadManager::instance();
    bool isFirst(int device) const
    {
        const QList<int> all = manager->connectedGamepads();
        return !all.isEmpty() && all.first() == device;
    }
};

Gamepad::Gamepad(QObject *parent)
    : QObject(parent)
    , d(std::make_unique<Private>())
{
    connect(d->manager, &QGamepadManager::connectedGamepadsChanged, this, &Gamepad::connectedChanged);
    connect(d->manager, &QGamepadManager::gamepadAxisEvent, this,
            [this](int device, QGamepadManager::GamepadAxis axis, double value) {
                if (d->isFirst(device) && !axisName(axis).isEmpty())
                    Q_EMIT axisMoved(axisName(axis), pointsDown(axis) ? -value : value);
            });
    connect(d->manager, &QGamepadManager::gamepadButtonPressEvent, this,
            [this](int device, QGamepadManager::GamepadButton button, double) {
                if (d->isFirst(device) && button == QGamepadManager::ButtonA)
                    Q_EMIT armPressed();
            });
}

bool Gamepad::isConnected() const
{
    return !d->manager->connectedGamepads().isEmpty();
}

QString Gamepad::absence() const
{
    return isConnected() ? QString() : tr("No gamepad is plugged in.");
}

}  // namespace qplc

#else

namespace qplc {

struct Gamepad::Private
{
};

Gamepad::Gamepad(QObject *parent)
    : QObject(parent)
{
}

bool Gamepad::isConnected() const
{
    return false;
}

QString Gamepad::absence() const
{
    return tr("This program was built without support for gamepads.");
}

}  // namespace qplc

#endif

qplc::Gamepad::~Gamepad() = default;
