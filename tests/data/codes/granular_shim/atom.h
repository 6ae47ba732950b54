#include "granular_model.h"
