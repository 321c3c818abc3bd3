// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QVariant>

class QDBusPendingCallWatcher;
class QDBusVariant;

namespace qplc {

/// What the desktop says about light and dark through its settings portal (D-Bus,
/// org.freedesktop.portal.Settings, key color-scheme of org.freedesktop.appearance), now and when
/// it changes. It says nothing where there is no portal or no session bus. Part of libraries that
/// are built where Qt has its module for D-Bus.
class ColorSchemePortal : public QObject
{
    Q_OBJECT
public:
    enum Scheme { NoPreference, Dark, Light };

    /// Asks, and does not wait for the answer.
    explicit ColorSchemePortal(QObject *parent = nullptr);

    /// Of the value that the portal gives; a variant may stand in a variant.
    static Scheme schemeOf(QVariant value);

Q_SIGNALS:
    void told(qplc::ColorSchemePortal::Scheme scheme);

private Q_SLOTS:
    void handleChange(const QString &group, const QString &key, const QDBusVariant &value);
    void handleAnswer(QDBusPendingCallWatcher *answer);
};

}  // namespace qplc
