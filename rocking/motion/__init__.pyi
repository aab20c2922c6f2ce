from .batch import integrate_batch as integrate_batch
from .integration import integrate as integrate
from .members import MemberResponses as MemberResponses
from .members import Members as Members
from .members import integrate_members as integrate_members
from .response import Response as Response
