// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "gui/window/ColorSchemePortal.h"

#include <QtCore/QProcess>
#include <QtCore/QStandardPaths>
#include <QtDBus/QtDBus>

using namespace qplc;

/// The portal of a desktop.
class FakePortal : public QObject
{
    Q_OBJECT
    Q_CLASSINFO("D-Bus Interface", "org.freedesktop.portal.Settings")

public:
    uint scheme = 1;

public Q_SLOTS:
    Q_SCRIPTABLE QDBusVariant Read(const QString &group, const QString &key)
    {
        questions << group + QLatin1Char('/') + key;
        return QDBusVariant(QVariant::fromValue(QDBusVariant(scheme)));
    }

Q_SIGNALS:
    Q_SCRIPTABLE void SettingChanged(const QString &group, const QString &key, const QDBusVariant &value);

public:
    QStringList questions;
};

class tst_ColorSchemePortal : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void portalValuesMapToSchemes();
    void portalReportsTheSchemeAndEachChange();
};

void tst_ColorSchemePortal::portalValuesMapToSchemes()
{
    QCOMPARE(ColorSchemePortal::schemeOf(0U), ColorSchemePortal::NoPreference);
    QCOMPARE(ColorSchemePortal::schemeOf(1U), ColorSchemePortal::Dark);
    QCOMPARE(ColorSchemePortal::schemeOf(2U), ColorSchemePortal::Light);
    QCOMPARE(ColorSchemePortal::schemeOf(7U), ColorSchemePortal::NoPreference);
    QCOMPARE(ColorSchemePortal::schemeOf(QVariant()), ColorSchemePortal::NoPreference);
    QCOMPARE(ColorSchemePortal::schemeOf(QStringLiteral("dark")), ColorSchemePortal::NoPreference);
    const QVariant within = QVariant::fromValue(QDBusVariant(QVariant::fromValue(QDBusVariant(1U))));
    QCOMPARE(ColorSchemePortal::schemeOf(within), ColorSchemePortal::Dark);
}

void tst_ColorSchemePortal::portalReportsTheSchemeAndEachChange()
{
    const QString daemon = QStandardPaths::findExecutable(QStringLiteral("dbus-daemon"));
    if (daemon.isEmpty())
        QSKIP("there is no dbus-daemon on this computer");
    QProcess bus;
    bus.start(daemon, {QStringLiteral("--session"), QStringLiteral("--print-address"), QStringLiteral("--nofork")});
    QVERIFY(bus.waitForReadyRead(10000));
    const QByteArray address = bus.readLine().trimmed();
    qputenv("DBUS_SESSION_BUS_ADDRESS", address);
    {
        FakePortal portal;
        QDBusConnection desktop
            = QDBusConnection::connectToBus(QString::fromLatin1(address), QStringLiteral("desktop"));
        QVERIFY(desktop.registerService(QStringLiteral("org.freedesktop.portal.Desktop")));
        QVERIFY(desktop.registerObject(QStringLiteral("/org/freedesktop/portal/desktop"), &portal,
                                       QDBusConnection::ExportScriptableContents));
        ColorSchemePortal listener;
        QVector<int> told;
        connect(&listener, &ColorSchemePortal::told, &listener,
                [&told](ColorSchemePortal::Scheme scheme) { told << int(scheme); });
        QTRY_COMPARE(told, QVector<int>{ColorSchemePortal::Dark});
        QCOMPARE(portal.questions, QStringList{QStringLiteral("org.freedesktop.appearance/color-scheme")});
        Q_EMIT portal.SettingChanged(QStringLiteral("org.freedesktop.appearance"), QStringLiteral("contrast"),
                                     QDBusVariant(1U));
        Q_EMIT portal.SettingChanged(QStringLiteral("org.freedesktop.appearance"), QStringLiteral("color-scheme"),
                                     QDBusVariant(2U));
        QTRY_COMPARE(told, (QVector<int>{ColorSchemePortal::Dark, ColorSchemePortal::Light}));
    }
    QDBusConnection::disconnectFromBus(QStringLiteral("desktop"));
    bus.kill();
    bus.waitForFinished();
}

QTEST_MAIN(tst_ColorSchemePortal)
#include "tst_ColorSchemePortal.moc"
