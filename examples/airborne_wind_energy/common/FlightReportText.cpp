// SPDX-License-Identifier: Apache-2.0
#include "FlightReportText.h"

#include <QtCore/QJsonDocument>
#include <QtCore/QSaveFile>

namespace awe {

namespace {

double number(const QJsonObject &report, const char *field)
{
    return report.value(QLatin1String(field)).toDouble();
}

QString row(const char *label, const QString &value)
{
    return QStringLiteral("  %1 %2\n").arg(QString::fromLatin1(label), -18).arg(value);
}

QString cycles(int count)
{
    return count == 1 ? QStringLiteral("1 cycle") : QStringLiteral("%1 cycles").arg(count);
}

/// What the winch drive made of the energy, and how well it followed.
QString winchRows(const QJsonObject &winch)
{
    const double mechanical = number(winch, "mechanical_energy_J");
    const double losses = number(winch, "losses_J");
    return row("winch drive",
               QStringLiteral("%1 kJ mechanical, %2 kJ electrical, losses %3 kJ (%4 %)")
                   .arg(mechanical * 1e-3, 0, 'f', 1)
                   .arg(number(winch, "electrical_energy_J") * 1e-3, 0, 'f', 1)
                   .arg(losses * 1e-3, 0, 'f', 1)
                   .arg(mechanical > 0.0 ? 100.0 * losses / mechanical : 0.0, 0, 'f', 1))
        + row("winch speed",
              QStringLiteral("%1 m/s rms from what was wanted, at most %2 m/s; position %3 m off")
                  .arg(number(winch, "speed_error_rms_m_s"), 0, 'f', 3)
                  .arg(number(winch, "speed_error_max_m_s"), 0, 'f', 2)
                  .arg(number(winch, "position_error_m"), 0, 'f', 2))
        + row("winch current",
              QStringLiteral("%1 A at most; without the drive for %2 s, interruptions %3")
                  .arg(number(winch, "max_current_A"), 0, 'f', 0)
                  .arg(number(winch, "disabled_s"), 0, 'f', 2)
                  .arg(number(winch, "interruptions")));
}

/// What the options of the plant add to the power.
QString powerRows(const QJsonObject &report)
{
    QString text;
    const QJsonValue electrical = report.value(QStringLiteral("electrical_power_W"));
    const double mechanical = number(report, "mean_power_W");
    if (!electrical.isUndefined())
        text += row("electrical power",
                    QStringLiteral("%1 W, %2 % of the mean power")
                        .arg(electrical.toDouble(), 0, 'f', 0)
                        .arg(mechanical > 0.0 ? 100.0 * electrical.toDouble() / mechanical : 0.0, 0, 'f', 1));
    const QJsonValue turbines = report.value(QStringLiteral("turbine_power_W"));
    if (!turbines.isUndefined())
        text += row("turbines on board", QStringLiteral("%1 W").arg(turbines.toDouble(), 0, 'f', 0));
    return text;
}

/// The flights from and to a mast.
QString mastRow(const QJsonObject &report)
{
    const QString end
        = report.value(QStringLiteral("landed")).toBool() ? QStringLiteral("; on the mast at the end") : QString();
    return row("mast",
               QStringLiteral("starts %1, dockings %2, the fastest at %3 m/s%4")
                   .arg(number(report, "starts"))
                   .arg(number(report, "dockings"))
                   .arg(number(report, "docking_speed_m_s"), 0, 'f', 2)
                   .arg(end));
}

QString notWritable(const QSaveFile &file)
{
    return QStringLiteral("cannot write the report %1: %2; choose another file")
        .arg(file.fileName(), file.errorString());
}

}  // namespace

QString summary(const QJsonObject &report)
{
    QString text = QStringLiteral("Flight of %1 s in %2 s (%3 x real time)\n")
                       .arg(number(report, "simulated_s"), 0, 'f', 1)
                       .arg(number(report, "wall_s"), 0, 'f', 2)
                       .arg(number(report, "real_time_factor"), 0, 'f', 1);
    if (report.value(QStringLiteral("crashed")).toBool())
        text += QStringLiteral("  THE KITE CRASHED after %1 s: it %2\n")
                    .arg(number(report, "crashed_after_s"), 0, 'f', 1)
                    .arg(report.value(QStringLiteral("hit_mast")).toBool() ? QStringLiteral("hit the mast")
                                                                           : QStringLiteral("came down to the ground"));
    if (report.contains(QStringLiteral("machine_off_after_s")))
        text += QStringLiteral("  THE MACHINE OF THE WINCH WAS SWITCHED OFF after %1 s: it was faster than "
                               "largestSpeed of [winch], and its brake holds the drum\n")
                    .arg(number(report, "machine_off_after_s"), 0, 'f', 1);
    if (report.value(QStringLiteral("no_kite")).toBool())
        text += QStringLiteral("  There was no kite: no node wrote its position. Start awe_model before the flight.\n");
    text += row("energy", QStringLiteral("%1 kJ").arg(number(report, "energy_J") * 1e-3, 0, 'f', 1));
    text += row("mean power",
                QStringLiteral("%1 W, eta %2 (%3 per mean cubed wind)")
                    .arg(number(report, "mean_power_W"), 0, 'f', 0)
                    .arg(number(report, "eta"), 0, 'f', 3)
                    .arg(number(report, "eta_per_mean_cubed_wind"), 0, 'f', 3));
    text += powerRows(report);
    text += row("reeling out, in",
                QStringLiteral("%1 W, %2 W")
                    .arg(number(report, "reel_out_power_W"), 0, 'f', 0)
                    .arg(number(report, "reel_in_power_W"), 0, 'f', 0));
    text += row("greatest power", QStringLiteral("%1 W").arg(number(report, "max_power_W"), 0, 'f', 0));
    text += row("kite speed",
                QStringLiteral("%1 m/s mean, %2 m/s at most")
                    .arg(number(report, "mean_speed_m_s"), 0, 'f', 1)
                    .arg(number(report, "max_speed_m_s"), 0, 'f', 1));
    text += row(
        "pumping cycles",
        QStringLiteral("%1, recoveries %2").arg(number(report, "pumping_cycles")).arg(number(report, "recoveries")));
    if (report.contains(QStringLiteral("landed")))
        text += mastRow(report);
    text += row("lowest altitude", QStringLiteral("%1 m").arg(number(report, "min_altitude_m"), 0, 'f', 1));
    text += row("greatest force", QStringLiteral("%1 N").arg(number(report, "max_tether_force_N"), 0, 'f', 0));
    text += row("control cycles",
                QStringLiteral("%1, overruns %2, late answers %3")
                    .arg(number(report, "cycles"), 0, 'f', 0)
                    .arg(number(report, "overruns"))
                    .arg(number(report, "late_answers")));
    const QJsonValue deadTime = report.value(QStringLiteral("dead_time_cycles"));
    if (!deadTime.isUndefined())
        text += row("dead time", QStringLiteral("%1 from sensor to actuator").arg(cycles(deadTime.toInt())));
    const QJsonValue winch = report.value(QStringLiteral("winch"));
    if (winch.isObject())
        text += winchRows(winch.toObject());
    text += row("image digest", report.value(QStringLiteral("image_digest")).toString());
    return text;
}

bool writeReport(const QString &fileName, const QJsonObject &report, QString *error)
{
    QSaveFile file(fileName);
    const QByteArray text = QJsonDocument(report).toJson();
    if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit())
        return true;
    *error = notWritable(file);
    return false;
}

bool canWriteReport(const QString &fileName, QString *error)
{
    QSaveFile file(fileName);  // never committed: it leaves no trace
    if (file.open(QIODevice::WriteOnly))
        return true;
    *error = notWritable(file);
    return false;
}

}  // namespace awe
