/* SPDX-License-Identifier: Apache-2.0 */
#ifndef RTW_HEADER_Gearbox_types_h_
#define RTW_HEADER_Gearbox_types_h_
#include "rtwtypes.h"
#ifndef DEFINED_TYPEDEF_FOR_Gear_
#define DEFINED_TYPEDEF_FOR_Gear_

typedef enum {
  Gear_Reverse = -1,                   /* Default value */
  Gear_Neutral,
  Gear_First = 1
} Gear;

#endif

#ifndef DEFINED_TYPEDEF_FOR_ShaftBus_
#define DEFINED_TYPEDEF_FOR_ShaftBus_

typedef struct {
  int16_T speed;                       /* fixed point: 1/16 rad/s */
  real32_T torque[2];
} ShaftBus;

#endif

#ifndef DEFINED_TYPEDEF_FOR_DriveBus_
#define DEFINED_TYPEDEF_FOR_DriveBus_

typedef struct {
  ShaftBus shaft;
  ShaftBus wheels[2];
  boolean_T enabled;
} DriveBus;

#endif

/* Forward declaration for rtModel */
typedef struct tag_RTM_Gearbox_T RT_MODEL_Gearbox_T;

#endif
