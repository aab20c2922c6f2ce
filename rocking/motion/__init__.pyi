from .integration import integrate as integrate
from .integration import integrate_many as integrate_many
from .response import Response as Response
