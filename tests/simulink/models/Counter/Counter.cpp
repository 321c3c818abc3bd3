// SPDX-License-Identifier: Apache-2.0
#include "Counter.h"

CounterModelClass::CounterModelClass() : Counter_U(), Counter_Y(), m_count(100), Counter_M()
{
}

CounterModelClass::~CounterModelClass()
{
}

void CounterModelClass::initialize()
{
  Counter_U.increment = 0;
  Counter_Y.count = 0;
}

void CounterModelClass::step()
{
  Counter_Y.count = m_count;
  m_count += Counter_U.increment;
  if (m_count > 1000) {
    Counter_M.errorStatus = "counted too far";
  }
}

RT_MODEL_Counter_T * CounterModelClass::getRTM()
{
  return &Counter_M;
}
