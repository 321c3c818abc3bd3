// SPDX-License-Identifier: Apache-2.0
#include "Servo.h"

Servo::Servo() : Servo_U(), Servo_Y(), m_angle(0.25)
{
}

Servo::~Servo()
{
}

void Servo::initialize()
{
}

void Servo::step()
{
  Servo_Y.angle = m_angle;
  m_angle += 0.5 * (Servo_U.target - m_angle);
}
